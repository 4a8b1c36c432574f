#pragma once

// A list of the boxes of the index that are tested for a silhouette point, for pictures and tests.
//
// The index itself tests eight boxes at a time and keeps no list (block_kernels.h). This traversal tests the
// same boxes by the same inequality (box_tree.h), from the root down. A box that lies certainly on one side
// of the v-sphere decides all faces below it. Any other box is entered. The faces of a block that no box
// decides are tested one by one.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/hough/box_tree.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

struct WalkedBox {
    enum class Side : std::uint8_t {
        inside,     ///< Certainly inside the v-sphere, with all that is below.
        outside,    ///< Certainly outside.
        straddles,  ///< Not certain: entered, or a block whose faces are tested.
    };

    glm::vec3 center;  ///< Relative to the origin of Hough space.
    glm::vec3 extent;  ///< Half of its size.
    Side side;
    std::uint32_t height;  ///< Levels above a block; 0 is a block.
    /// The blocks below it, or itself: [first_block, first_block + block_count).
    std::uint32_t first_block;
    std::uint32_t block_count;

    /// Whether the traversal ends at this box.
    bool is_end() const noexcept { return side != Side::straddles || height == 0; }
};

/// The tree of the index over the faces of origin number `origin`, built again from the faces. O(faces).
BoxTree make_face_tree(const HoughOctree& octree, std::size_t origin);

/// Every box that `query` tests in `tree`, parents before their children. Boxes with is_end() contain each
/// block once. O(boxes tested).
std::vector<WalkedBox> walk_boxes(const BoxTree& tree, const BoxQuery& query);

}  // namespace rimline
