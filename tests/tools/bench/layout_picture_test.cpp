#include "tools/bench/layout_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using tools::LayoutPicture;
using tools::picture_layout;

TEST_CASE(
    "a picture of the layout accounts for every block, and looks at all that the v-sphere cuts") {
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    const HoughOctree octree(mesh);
    const LayoutPicture picture = picture_layout(octree, 1.25, 0.5, 0.05);
    CHECK(picture.blocks == octree.block_count());
    CHECK(picture.blocks_settled + picture.blocks_looked_at == picture.blocks);
    CHECK(picture.blocks_settled > picture.blocks / 4);

    const glm::dvec3 pole = mesh.radius() * glm::dvec3(picture.pole[0], picture.pole[1], 0.0);
    CHECK(glm::length(pole) == doctest::Approx(1.25 * mesh.radius()));
    std::uint32_t cut = 0;
    for (std::uint32_t block = 0; block < octree.block_count(); ++block) {
        std::uint32_t inside = 0;
        std::uint32_t outside = 0;
        for (std::uint32_t lane = 0; lane < k_block_size; ++lane) {
            const FaceId face = octree.face_at(block * k_block_size + lane);
            if (face == k_no_face) continue;
            const glm::dvec3 h = hough_point(mesh.plane(face), octree.origins()[0]).position;
            (glm::dot(h, h) < glm::dot(h, pole) ? inside : outside) += 1;
        }
        cut += inside > 0 && outside > 0;
    }
    CHECK(cut > 0);
    CHECK(picture.blocks_looked_at >= cut);
    CHECK(picture.blocks_looked_at < 3 * cut);
}

TEST_CASE(
    "what is drawn as settled lies on its side of the v-sphere, and what is drawn meets the "
    "plane") {
    const Mesh mesh(make_built_in_shape("knot", 8000));
    const HoughOctree octree(mesh);
    const LayoutPicture picture = picture_layout(octree, 1.25, 0.5, 0.05);
    const double x = 0.5 * picture.pole[0];
    const double y = 0.5 * picture.pole[1];
    const double radius = std::hypot(x, y);
    std::uint32_t settled = 0;
    for (const LayoutPicture::Box& box : picture.boxes) {
        if (box.end == LayoutPicture::End::looked_at) {
            CHECK(box.level == 0);
            continue;
        }
        ++settled;
        // Its nearest and farthest points in the plane.
        const double near_x = std::max({box.low[0] - x, 0.0, x - box.high[0]});
        const double near_y = std::max({box.low[1] - y, 0.0, y - box.high[1]});
        const double far_x = std::max(x - box.low[0], box.high[0] - x);
        const double far_y = std::max(y - box.low[1], box.high[1] - y);
        if (box.end == LayoutPicture::End::inside)
            CHECK(std::hypot(far_x, far_y) < radius);
        else
            CHECK(std::hypot(near_x, near_y) > radius);
    }
    CHECK(settled > 10);
    CHECK(picture.points.size() > 50);
    for (const LayoutPicture::Point& point : picture.points) CHECK(point.block < picture.blocks);
}
