#pragma once

// The boxes of Hough points that a traversal of the octree tests for a silhouette point, for pictures and tests.
//
// The nodes are those of the index: eight neighboring blocks in octree order, eight neighboring nodes, and so on
// (block_tree.h). The test is the thesis's: the box of a node's Hough points against the v-sphere. (The index
// decides a node by the box of its planes, which no picture of Hough space can show. It settles about the same
// nodes.) A box that lies certainly on one side of the v-sphere decides all faces below it. Any other box is
// entered. The faces of a block that no box decides are tested one by one.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/v_sphere.h"
#include "silhouette/mesh/homogeneous_point.h"

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

/// The boxes of the Hough points below each node of the index, for one of its origins.
class HoughBoxes {
public:
    /// Of the faces of origin number `origin`. O(faces).
    HoughBoxes(const HoughOctree& octree, std::size_t origin);

    std::uint32_t block_count() const noexcept {
        return static_cast<std::uint32_t>(levels_.front().size());
    }
    /// Every box that is tested from `point`, parents before their children. Boxes with is_end() contain each
    /// block once. O(boxes tested).
    std::vector<WalkedBox> walk(const HomogeneousPoint& point) const;

private:
    class Walk;

    glm::dvec3 origin_;
    std::vector<std::vector<HoughBox>> levels_;  // The blocks first, the root last.
};

}  // namespace rimline
