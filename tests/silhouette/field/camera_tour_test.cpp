// Tours against what plan_tour promises, with the order checked against tours of two views.

#include "silhouette/field/camera_tour.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "silhouette/field/best_views.h"
#include "silhouette/field/camera_path.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Checks what holds of every tour, and that a path can be made of it that keeps its distance.
void check_tour(const TangentialField& field, const std::vector<glm::dvec3>& views,
                const std::vector<TourNode>& nodes) {
    const UnitFrame& frame = field.frame();
    REQUIRE(nodes.size() == 2 * views.size());
    CHECK(nodes[0].view == 0u);
    std::vector<bool> passed(views.size(), false);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const TourNode& node = nodes[i];
        const glm::dvec3 point = frame.from_model(node.place);
        CHECK(node.view.has_value() == (i % 2 == 0));
        CHECK(node.votes == doctest::Approx(field.value(point)));
        if (node.view) {
            CHECK(node.place == views[*node.view]);
            CHECK_FALSE(passed[*node.view]);
            passed[*node.view] = true;
        }
        CHECK(glm::length(point) >= std::sqrt(3.0) - 1e-9);
        CHECK(glm::length(point) <= 2.0 + 1e-9);
        const double turn = angle_deg(point, frame.from_model(nodes[(i + 1) % nodes.size()].place));
        CHECK(turn > 0.01);
        CHECK(turn < 100.0);
        places.push_back(node.place);
    }
    const CameraPath path(frame.center, places);
    for (int i = 0; i < 2000; ++i)
        CHECK(glm::distance(path.position(i / 2000.0), frame.center) / frame.radius >=
              std::sqrt(3.0) - 1e-9);
}

TEST_CASE("a tour through the best views is greedy and closed" * doctest::test_suite("plain")) {
    for (const char* name : {"knot", "spring", "scene"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name, 1500));
        const TangentialField field = make_view_field(mesh);
        BestViewsOptions options;
        options.count = 5;
        std::vector<glm::dvec3> views;
        for (const BestView& view : find_best_views(field, options).views)
            views.push_back(view.eye);
        REQUIRE(views.size() == 5);
        const std::vector<TourNode> nodes = plan_tour(field, views);
        check_tour(field, views, nodes);
        // No view that is not yet passed has a better node on the way to it.
        std::vector<std::uint32_t> left = {1, 2, 3, 4};
        for (std::size_t i = 0; i + 2 < nodes.size(); i += 2) {
            const glm::dvec3& here = nodes[i].place;
            for (const std::uint32_t other : left) {
                const std::vector<glm::dvec3> pair = {here, views[other]};
                CHECK(nodes[i + 1].votes >= plan_tour(field, pair)[1].votes - 1e-6);
            }
            std::erase(left, *nodes[i + 2].view);
        }
        CHECK(left.empty());
    }
}

TEST_CASE("views opposite each other and views in one direction have a way between them") {
    const Mesh mesh(make_built_in_shape("knot", 1500));
    const TangentialField field = make_view_field(mesh);
    const auto at = [&](double x, double y, double z) {
        return field.frame().to_model(glm::dvec3(x, y, z));
    };
    const std::vector<std::vector<glm::dvec3>> tours = {
        {at(1.9, 0, 0), at(-1.8, 0, 0)},
        {at(1.9, 0, 0), at(-1.8, 1e-9, 0)},
        {at(0, 1.75, 0), at(0, 1.95, 0)},
        {at(0, 0, 1.8), at(0, 0, 1.8)},
        {at(1.9, 0, 0), at(-1.8, 0, 0), at(0, 1.8, 0), at(0, -1.8, 0), at(0, 0, 1.8),
         at(0, 0, -1.8)},
        {at(1.9, 0, 0), at(1.9, 1e-4, 0), at(1.9, 0.03, 0)}};
    for (const std::vector<glm::dvec3>& views : tours)
        check_tour(field, views, plan_tour(field, views));
}

TEST_CASE("tours through any views in the shell keep their promises") {
    const Mesh mesh(make_built_in_shape("spring", 500));
    const TangentialField field = make_view_field(mesh);
    Random random(7);
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<glm::dvec3> views;
        for (std::uint32_t i = random.below(4) + 2; i > 0; --i)
            views.push_back(
                field.frame().to_model((1.74 + 0.25 * std::abs(double{random.signed_unit()})) *
                                       glm::normalize(glm::dvec3(random.in_cube()))));
        check_tour(field, views, plan_tour(field, views));
    }
}

TEST_CASE("a cancelled tour stops") {
    const Mesh mesh(make_built_in_shape("knot", 500));
    const TangentialField field = make_view_field(mesh);
    const std::vector<glm::dvec3> views = {field.frame().to_model({1.9, 0, 0}),
                                           field.frame().to_model({0, 1.9, 0})};
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(plan_tour(field, views, {source.get_token(), {}}), Error);
}

}  // namespace
