#include "silhouette/hough/box_walk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;

TEST_CASE(
    "the ends of a walk hold every block once, and settle only what the face bits agree with") {
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    HoughOctreeOptions options;
    options.origins = {mesh.center(), mesh.center() + glm::dvec3(0.3, 0.1, -0.2)};
    const HoughOctree octree(mesh, options);
    std::uint32_t first_block = 0;
    for (std::size_t origin = 0; origin < octree.origins().size(); ++origin) {
        const HoughBoxes hough_boxes(octree, origin);
        for (const HomogeneousPoint& point : {HomogeneousPoint::viewpoint({2.0f, 0.7f, 3.0f}),
                                              HomogeneousPoint::direction({0.3f, -1.0f, 0.2f})}) {
            const auto boxes = hough_boxes.walk(point);
            std::vector<int> times(hough_boxes.block_count());
            std::uint32_t settled = 0;
            for (const WalkedBox& box : boxes) {
                if (!box.is_end()) continue;
                for (std::uint32_t i = 0; i < box.block_count; ++i) ++times[box.first_block + i];
                if (box.side == WalkedBox::Side::straddles) {
                    CHECK(box.height == 0);
                    continue;
                }
                settled += box.block_count;
                // Inside, a face is front where its plane is in front of the origin; outside, where not.
                const std::uint32_t begin = (first_block + box.first_block) * k_block_size;
                for (std::uint32_t i = 0; i < box.block_count * k_block_size; ++i) {
                    const FaceId face = octree.face_at(begin + i);
                    if (face == k_no_face) continue;
                    const HoughPoint h = hough_point(mesh.plane(face), octree.origins()[origin]);
                    if (h.side == 0) continue;
                    const bool inside = box.side == WalkedBox::Side::inside;
                    CHECK(is_front(mesh.plane(face), point) == (inside == (h.side > 0)));
                }
            }
            CHECK(std::ranges::all_of(times, [](int count) { return count == 1; }));
            CHECK(settled > hough_boxes.block_count() / 4);
        }
        first_block += hough_boxes.block_count();
    }
    CHECK(first_block == octree.block_count());
}

TEST_CASE("a mesh without planes has an empty tree to walk") {
    MeshSource line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.triangles = {{0, 1, 2}};
    const Mesh mesh(line);
    const HoughOctree octree(mesh);
    CHECK(HoughBoxes(octree, 0).walk(HomogeneousPoint::viewpoint({0.0f, 1.0f, 0.0f})).empty());
}
