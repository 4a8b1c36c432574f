#include "tools/view/hough_inspection.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/tools/view/opened_model.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

// By the definition: within the sphere whose poles are the origin and q, or before the plane.
bool is_inside(const HoughInspection& inspection, const glm::dvec3& h) {
    const glm::dvec3 q(inspection.pole());
    if (inspection.is_plane()) return glm::dot(h, q) > 0.0;
    return glm::distance(h, 0.5 * q) < 0.5 * glm::length(q);
}

}  // namespace

TEST_CASE("the inspector's points and settled boxes lie on their sides of the v-sphere") {
    const auto opened = tests::opened_model("shape:knot:30000");
    const ModelDocument& model = *opened;
    HoughInspection inspection(model);
    CHECK(inspection.point_count() == model.octree().statistics().faces);
    CHECK(inspection.points().size() <= HoughInspection::k_max_points);
    CHECK(inspection.points().size() > HoughInspection::k_max_points / 3);
    const HomogeneousPoint near = HomogeneousPoint::viewpoint({1.0f, 2.0f, 4.0f});
    const HomogeneousPoint sun = HomogeneousPoint::direction({1.0f, 2.0f, -1.0f});
    for (const HomogeneousPoint& point : {near, sun}) {
        inspection.update(model, point);
        CHECK(inspection.is_plane() == point.is_direction());
        std::uint32_t inside = 0;
        for (const HoughInspection::Point& shown : inspection.points()) {
            CHECK(glm::length(shown.position) < 1.0f + 1e-4f);
            // A rounding away from the sphere either is right.
            const glm::dvec3 h(shown.position);
            const bool sure =
                is_inside(inspection, h * 1.0001) == is_inside(inspection, h * 0.9999);
            if (sure) CHECK(shown.inside == is_inside(inspection, h));
            inside += shown.inside;
        }
        CHECK(inside > 0);
        CHECK(inside < inspection.points().size());
        std::uint32_t corners = 0;
        for (const WalkedBox& box : inspection.boxes()) {
            if (box.side == WalkedBox::Side::straddles) continue;
            for (int i = 0; i < 8; ++i) {
                const glm::dvec3 sign((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
                const glm::dvec3 corner =
                    glm::dvec3(box.center) + 0.9999 * sign * glm::dvec3(box.extent);
                CHECK(is_inside(inspection, corner) == (box.side == WalkedBox::Side::inside));
                ++corners;
            }
        }
        CHECK(corners > 0);
        const HoughInspection::Blocks& blocks = inspection.blocks();
        CHECK(blocks.all == model.octree().block_count());
        CHECK(blocks.inside + blocks.outside + blocks.tested == blocks.all);
        CHECK(blocks.tested > 0);
        CHECK(blocks.tested < blocks.all / 2);
    }
}

TEST_CASE("from the origin of Hough space nothing is inside the v-sphere") {
    const auto opened = tests::opened_model("shape:box");
    const ModelDocument& model = *opened;
    HoughInspection inspection(model);
    inspection.update(model, HomogeneousPoint::viewpoint({0.0f, 0.0f, 0.0f}));
    // The v-sphere is that point alone.
    CHECK(inspection.blocks().inside == 0);
    for (const HoughInspection::Point& point : inspection.points()) CHECK_FALSE(point.inside);
}
