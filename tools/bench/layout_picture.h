#pragma once

// A picture of the octree's layout: a section of Hough space.
//
// The plane z = 0 through the origin of Hough space contains the poles 0 and q of a v-sphere with q in that
// plane, and cuts it in a great circle. Boxes that meet the plane are rectangles. A traversal from the root
// ends at boxes that are certainly on one side of the v-sphere, and at blocks that no box decides. These are
// drawn. Coordinates are relative to the origin, in units of the mesh's radius.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "silhouette/hough/hough_octree.h"

namespace rimline::tools {

struct LayoutPicture {
    struct Point {
        double x, y;
        std::uint32_t block;  ///< The number of its block of sixteen faces, in octree order.
    };
    enum class End : std::uint8_t { inside, outside, looked_at };
    struct Box {
        std::array<double, 2> low, high;
        std::uint32_t level;  ///< Levels above a block; 0 for a block itself.
        End end;
    };

    std::array<double, 2> pole{};      ///< q.
    std::vector<Point> points;         ///< Hough points near the plane.
    std::vector<Box> boxes;            ///< Boxes that meet the plane.
    std::uint32_t blocks = 0;          ///< All blocks of the tree.
    std::uint32_t blocks_settled = 0;  ///< Those decided by their box or one above.
    std::uint32_t blocks_looked_at = 0;
    std::uint32_t boxes_tested = 0;
};

std::string_view name_of(LayoutPicture::End end) noexcept;

/// The tree over the faces of `octree`'s first origin, for a viewpoint at a distance of `radii` mesh radii
/// in the direction `angle_rad` from +x towards +y. Has the points within `thickness` radii of the plane.
/// O(faces).
LayoutPicture picture_layout(const HoughOctree& octree, double radii, double angle_rad,
                             double thickness);

}  // namespace rimline::tools
