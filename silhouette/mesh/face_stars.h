#pragma once

// Parts of a FaceTree whose faces all share a vertex, as those around the tip of a cone or the center of a disc. The
// boxes of all faces of a star meet, in its vertex: n of them are n^2/2 pairs. But two parts of one star without a common
// direction, seen from the vertex, meet in nothing else; nor do parts of two stars that a plane through both vertices
// separates, as a sector of a cone and another one of its base.

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Whether two faces have one corner in common, and no other point, certainly: seen from it they have no common direction.
/// False for many that do not, too.
bool meet_in_corner_only(const Mesh& mesh, std::uint32_t face, std::uint32_t other);

class FaceStars {
public:
    /// `tree` is that of `mesh`. O(n): next to nothing where no block of the tree has a vertex that all of its faces
    /// share. Throws Error{cancelled}.
    FaceStars(const Mesh& mesh, const FaceTree& tree, const std::stop_token& stop);

    /// Whether two nodes, blocks or larger ones, are parts of stars that meet at most in the vertex of both, certainly.
    bool are_apart(const FaceTree::Node& a, const FaceTree::Node& b) const noexcept {
        return !nodes_.empty() && are_apart(nodes_[a.number], nodes_[b.number]);
    }

private:
    static constexpr std::uint32_t k_none = 0xffffffffu;
    struct Star {
        std::uint32_t center = k_none;
        FaceBox directions;  // From the center to the other points, of length 1.
    };

    bool are_apart(const Star& a, const Star& b) const noexcept;
    static Star star_of_block(const Mesh& mesh, std::span<const std::uint32_t> faces);
    static Star joined(const Star& a, const Star& b);

    const Mesh& mesh_;
    std::vector<Star> nodes_;  // By their numbers; none where no block is a star.
};

}  // namespace rimline
