#pragma once

// Which boxes of the index a silhouette point looks at, written down one by one: to be drawn and tested.
//
// The index itself walks eight boxes at a time and keeps nothing (block_kernels.h). This walk tests the
// same boxes by the same inequality (box_tree.h), from the root down: a box that is certainly on one side
// of the v-sphere settles all below it, any other is entered, and a block that no box settles is looked
// at face by face.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/hough/box_tree.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

struct WalkedBox {
    enum class Side : std::uint8_t {
        inside,     ///< Certainly within the v-sphere, with all that is below.
        outside,    ///< Certainly not.
        straddles,  ///< Not certain: entered, or a block that is looked at.
    };

    glm::vec3 center;  ///< Relative to the origin of Hough space.
    glm::vec3 extent;  ///< Half of its size.
    Side side;
    std::uint32_t height;  ///< Levels above a block; 0 is a block.
    std::uint32_t
        first_block;  ///< Those below it (or it): [first_block, first_block + block_count).
    std::uint32_t block_count;

    /// Whether the walk stops here.
    bool is_end() const noexcept { return side != Side::straddles || height == 0; }
};

/// The tree that the index keeps over the faces of origin number `origin`, made again from the faces.
/// O(faces).
BoxTree make_face_tree(const HoughOctree& octree, std::size_t origin);

/// Every box that `query` tests in `tree`, parents before their children. The ends among them hold each
/// block once. O(boxes tested).
std::vector<WalkedBox> walk_boxes(const BoxTree& tree, const BoxQuery& query);

}  // namespace rimline
