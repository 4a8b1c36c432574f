#pragma once

// `rimline bench fields`: what tangential distance fields cost, against summing all planes.
//
//   lattice    the 17³ lattice of a search, in the ball of radius 3, for origins. Brute force sums all
//              planes with the same loops for wide registers. Both on one thread, rounds alternating.
//   origins    four origins, from the mesh to the points, on all threads.
//
// Brute force is compared with a plain sum in double at some of the points, clusters with brute force at all
// of them: an error beyond the bound fails the bench.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/targets.h"
#include "tools/command.h"

namespace rimline::tools {

struct FieldBenchOptions {
    std::uint32_t rounds = 5;
};

/// A lattice summed in clusters. Shares are of the lattice's greatest value.
struct LatticeRow {
    double bound = 0.0;     ///< Asked for, and kept at every point.
    double error = 0.0;     ///< The greatest there was.
    double ms = 0.0;        ///< The least of the rounds.
    double clusters = 0.0;  ///< Mean, of a point.
    double planes = 0.0;
};

struct FieldBenchResult {
    std::string model;
    std::uint32_t faces = 0;
    std::uint32_t points = 0;
    double build_ms = 0.0;
    double brute_ms = 0.0;
    std::vector<LatticeRow> lattice;  ///< From the loosest bound to the closest.
    double origins_ms = 0.0;
    std::string difference;  ///< What is wrong, if anything.

    /// The fastest whose errors are at most a thousandth of the greatest value.
    const LatticeRow* measured() const;
};

FieldBenchResult bench_fields(const std::string& model, const Mesh& mesh,
                              const FieldBenchOptions& options, const Context& context);

void print_result(const FieldBenchResult& result);
nlohmann::ordered_json to_json(const FieldBenchResult& result);
/// Of igea the goals; of others, that clusters are not slower than brute force.
std::vector<Target> targets_of(const FieldBenchResult& result);

}  // namespace rimline::tools
