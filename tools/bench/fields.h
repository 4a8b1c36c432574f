#pragma once

// `rimline bench fields`: the time of tangential distance fields, against summing all planes.
//
//   lattice    the 17³ lattice of a search, in the ball of radius 3, for origins. Brute force sums all
//              planes with the same loops for wide registers. Both use one thread, in alternating rounds.
//   origins    four origins, from the mesh to the points, on all threads.
//
// Brute force is compared with a plain sum in double at some of the points, clusters with brute force at all
// points. An error beyond the bound fails the bench.

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
    double bound = 0.0;     ///< Requested error bound, kept at every point.
    double error = 0.0;     ///< The greatest error.
    double ms = 0.0;        ///< The least of the rounds.
    double clusters = 0.0;  ///< Mean number for a point.
    double planes = 0.0;
};

struct FieldBenchResult {
    std::string model;
    std::uint32_t faces = 0;
    std::uint32_t points = 0;
    double build_ms = 0.0;
    double brute_ms = 0.0;
    std::vector<LatticeRow> lattice;  ///< In order of decreasing bounds.
    double origins_ms = 0.0;
    std::string difference;  ///< The first error; empty if none.

    /// The fastest row with errors of at most a thousandth of the greatest value.
    const LatticeRow* measured() const;
};

FieldBenchResult bench_fields(const std::string& model, const Mesh& mesh,
                              const FieldBenchOptions& options, const Context& context);

void print_result(const FieldBenchResult& result);
nlohmann::ordered_json to_json(const FieldBenchResult& result);
/// Igea has goals of its own. For other meshes, clusters must not be slower than brute force.
std::vector<Target> targets_of(const FieldBenchResult& result);

}  // namespace rimline::tools
