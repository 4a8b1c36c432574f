#pragma once

// Comparisons of the index and the methods with brute force, and their counts.
//
// An extraction is one result of one method for one (mesh, point) pair. A move is one change set of a
// SilhouetteTracker, checked completely (shadow_consumer.h), or one update of another method.

#include <cstdint>
#include <set>
#include <string>

#include "silhouette/mesh/mesh.h"
#include "tests/silhouette/methods/proof/oracle.h"

namespace rimline::tests {

struct Tally {
    std::uint64_t meshes = 0;
    std::uint64_t layouts = 0;               ///< Indices built, of one origin or several.
    std::set<std::string> instruction_sets;  ///< Of the index.
    std::uint64_t extractions = 0;
    std::uint64_t moves = 0;
    std::uint64_t edges = 0;          ///< Of the silhouettes extracted.
    std::uint64_t flips = 0;          ///< Faces that turned in moves.
    std::uint64_t fresh_moves = 0;    ///< For which the tracker found the silhouette afresh.
    std::uint64_t checked_looks = 0;  ///< The oracle's own checks, and what they met.
    std::uint64_t rounded_bits = 0;

    void add(const Oracle& oracle) {
        checked_looks += oracle.checked_looks();
        rounded_bits += oracle.rounded_bits();
    }
};

/// For MESSAGE.
std::string to_string(const Tally& tally);

/// The numbers of extractions and of moves for one mesh.
struct Quota {
    std::uint32_t extractions, moves;
};

/// Fails the running test case unless the index is right at at least `quota` points and moves, shared out
/// among the center as origin, all of origin_lists.h, and every instruction set; each with points of its
/// own.
void prove_index(const Mesh& mesh, const Quota& quota, std::uint64_t seed, Tally& tally);

/// The same for each exact method of silhouette_methods(), `quota` for each, from the mesh's center and
/// from an origin elsewhere.
void prove_methods(const Mesh& mesh, const Quota& quota, std::uint64_t seed, Tally& tally);

}  // namespace rimline::tests
