#pragma once

// Which faces of a mesh may meet outside of the corners and edges that they share. Quick and certain tests in
// floats leave out the others: nearly all pairs where faces are not coplanar. What is left is decided by whoever
// asks: by exact signs (silhouette/lines/face_contacts.h), or with a margin (solid.h).
//
//   boxes apart               the tree of the faces leaves out most of them
//   beside a plane            all corners of one but the shared ones lie on one side of the other's plane
//   sides pass by             each side of one that crosses the other's plane passes it outside, and the reverse

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct FacePair {
    std::uint32_t a, b;
};

/// Takes pairs of faces, and returns whether to go on. Called on several threads at once. It must not use oneTBB.
using TakeFacePairs = std::function<bool(std::span<const FacePair>)>;

/// Passes each pair of faces that may meet elsewhere than in shared corners and edges to `take`, once, in no order.
/// Returns false where `take` did, or where the boxes of more than `max_pairs` pairs meet: then pairs are missing.
/// The same pairs on every machine. `tree` is that of `mesh`. Uses all threads of oneTBB: O(n log n + pairs whose
/// boxes meet), about 0.1 microseconds a face of a scanned model. Throws Error{cancelled}.
bool each_near_face_pair(const Mesh& mesh, const FaceTree& tree, const TakeFacePairs& take,
                         const LongCall& call = {},
                         std::uint64_t max_pairs = std::numeric_limits<std::uint64_t>::max());

}  // namespace rimline
