#pragma once

// What the production layout looks like: a cut through Hough space, to be drawn.
//
// The plane z = 0 through the origin of Hough space holds the poles 0 and q of a v-sphere with q in that
// plane, and cuts it in a great circle. Boxes that meet the plane show as rectangles. A walk from the root
// ends at boxes that are certainly on one side of the v-sphere and at blocks that no box settles; they
// are the ones to draw. Coordinates are relative to the origin, in units of the mesh's radius.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "silhouette/hough/hough_octree.h"

namespace rimline::tools {

struct LayoutPicture {
    struct Point {
        double x, y;
        std::uint32_t block;  ///< Of sixteen faces, in octree order.
    };
    enum class End : std::uint8_t { inside, outside, looked_at };
    struct Box {
        std::array<double, 2> low, high;
        std::uint32_t level;  ///< 0: a block; more: so many levels above one.
        End end;
    };

    std::array<double, 2> pole{};      ///< q.
    std::vector<Point> points;         ///< Hough points near the plane.
    std::vector<Box> boxes;            ///< Those that meet the plane.
    std::uint32_t blocks = 0;          ///< In all of the tree, met by the plane or not,
    std::uint32_t blocks_settled = 0;  ///< settled by a box of theirs or above,
    std::uint32_t blocks_looked_at = 0;
    std::uint32_t boxes_tested = 0;
};

std::string_view name_of(LayoutPicture::End end) noexcept;

/// The tree over the faces of `octree`'s first origin, as seen from `radii` mesh radii away in the
/// direction `angle_rad` from +x towards +y. Points within `thickness` radii of the plane. O(faces).
LayoutPicture picture_layout(const HoughOctree& octree, double radii, double angle_rad,
                             double thickness);

}  // namespace rimline::tools
