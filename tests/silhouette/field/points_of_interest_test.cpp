#include "silhouette/field/points_of_interest.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/field/reference_sum.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

constexpr SearchDomain k_ball{0.0, 3.0};
constexpr SearchDomain k_shell{std::numbers::sqrt3, 2.0};

TEST_CASE("the first point is within 1% of the greatest of a 33^3 lattice" *
          doctest::test_suite("plain")) {
    for (const auto& [shape, faces] : {std::pair<const char*, std::uint32_t>{"knot", 1000},
                                       {"torus", 1000},
                                       {"spring", 1000},
                                       {"scene", 1000}}) {
        const UnitPlanes planes{Mesh(make_built_in_shape(shape, faces))};
        for (const auto& [f, domain] : {std::pair{origin_function(), k_ball},
                                        {view_function(), k_shell},
                                        {light_function(), k_shell}}) {
            CAPTURE(shape);
            const TangentialField field(planes, f);
            std::vector<glm::dvec3> lattice;
            for (int x = -16; x <= 16; ++x)
                for (int y = -16; y <= 16; ++y)
                    for (int z = -16; z <= 16; ++z) {
                        const glm::dvec3 p = domain.outer_radius / 16.0 * glm::dvec3(x, y, z);
                        if (domain.contains(p)) lattice.push_back(p);
                    }
            std::vector<double> votes(lattice.size());
            field.values(lattice, votes);
            const auto found = find_points_of_interest(field, domain, {});
            REQUIRE(found.points.size() == 1);
            CHECK(found.points[0].votes >= 0.99 * *std::ranges::max_element(votes));
            CHECK(std::abs(found.points[0].votes - field.value(found.points[0].point)) == 0.0);
            const double radius = glm::length(found.points[0].point);
            CHECK(radius >= domain.inner_radius - 1e-12);
            CHECK(radius <= domain.outer_radius + 1e-12);
        }
    }
}

TEST_CASE("next points have the votes that those before them have not had") {
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 2000))};
    const TangentialFunction f = origin_function();
    const TangentialField field(planes, f);
    InterestOptions options;
    options.count = 4;
    const auto found = find_points_of_interest(field, k_ball, options);
    REQUIRE(found.points.size() == 4);
    std::vector<glm::dvec3> chosen = {found.points[0].point};
    for (std::size_t k = 1; k < 4; ++k) {
        const PointOfInterest& point = found.points[k];
        CHECK(std::abs(point.votes -
                       tests::reference_discounted(planes, f, FieldOptions::Weight::count, chosen,
                                                   point.point)) <= field.error_bound());
        CHECK(point.votes <= found.points[k - 1].votes);
        for (const glm::dvec3& c : chosen) CHECK(glm::distance(c, point.point) > 0.05);
        chosen.push_back(point.point);
    }
}

// Also of a peak on the lattice, whose samples are less exact.
TEST_CASE("points have the votes of the field at a tolerance that shows") {
    for (const char* shape : {"knot", "torus", "spring", "scene"}) {
        CAPTURE(shape);
        const UnitPlanes planes{Mesh(make_built_in_shape(shape, 2000))};
        const TangentialField field(planes, origin_function(), {0.1});
        DiscountedField left(field);
        InterestOptions options;
        options.count = 4;
        options.tolerance = 0.2;  // Climbs end where they start, or near it.
        for (const PointOfInterest& point :
             find_points_of_interest(field, k_ball, options).points) {
            CHECK(point.votes == left.value(point.point));
            left.discount(point.point);
        }
    }
}

// Smooth, without any symmetry, small in places.
std::vector<double> made_up_ratios(std::span<const glm::dvec3> points) {
    std::vector<double> ratios;
    for (const glm::dvec3& p : points)
        ratios.push_back(std::clamp(0.5 + 0.3 * std::sin(3.0 * p.x + p.y) + 0.4 * p.z, 0.0, 1.0));
    return ratios;
}

TEST_CASE("weighing lazily finds what weighing all finds with fewer weighed" *
          doctest::test_suite("plain")) {
    for (const auto& [shape, steady] : {std::pair{"knot", false},
                                        {"torus", false},
                                        {"scene", false},
                                        {"knot", true},
                                        {"torus", true},
                                        {"scene", true}}) {
        CAPTURE(shape);
        CAPTURE(steady);
        const UnitPlanes planes{Mesh(make_built_in_shape(shape, 1000))};
        const TangentialField field(planes, view_function());
        InterestOptions options;
        options.count = 4;
        options.steady = steady;
        std::size_t greatest_batch = 0;
        options.weigh = [&](std::span<const glm::dvec3> points, std::size_t) {
            greatest_batch = std::max(greatest_batch, points.size());
            return made_up_ratios(points);
        };
        const auto lazy = find_points_of_interest(field, k_shell, options);
        options.weighs_all = true;
        const auto all = find_points_of_interest(field, k_shell, options);
        REQUIRE(lazy.points.size() == all.points.size());
        for (std::size_t i = 0; i < all.points.size(); ++i) {
            CHECK(lazy.points[i].point == all.points[i].point);
            CHECK(lazy.points[i].score() == all.points[i].score());
        }
        CHECK(all.weighed == all.candidates);
        CHECK(lazy.candidates == all.candidates);
        CHECK(lazy.weighed < all.weighed);
        CHECK(greatest_batch <= options.weigh_batch);
    }
}

TEST_CASE("of symmetric maxima the one with the greatest x then y then z is first") {
    const UnitPlanes planes{Mesh(tests::octahedron())};
    const TangentialField field(planes, light_function());
    InterestOptions options;
    options.count = 8;
    const auto found = find_points_of_interest(field, k_shell, options);
    REQUIRE(!found.points.empty());
    CHECK(found.points[0].point.x > 0.0);
    CHECK(found.points[0].point.y > -1e-2);
    CHECK(found.points[0].point.z > -1e-2);
}

TEST_CASE("points end where no plane has votes left") {
    const TangentialField none(UnitPlanes(Mesh(MeshSource{})), origin_function());
    CHECK(find_points_of_interest(none, k_ball, {}).points.empty());

    const UnitPlanes one{Mesh(MeshSource{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}})};
    const TangentialField field(one, origin_function());
    InterestOptions options;
    options.count = 10;
    const auto found = find_points_of_interest(field, k_ball, options);
    REQUIRE(found.points.size() == 1);
    CHECK(found.points[0].votes == doctest::Approx(1.0));

    options.weigh = [](std::span<const glm::dvec3> points, std::size_t) {
        return std::vector<double>(points.size(), 0.0);
    };
    CHECK(find_points_of_interest(field, k_ball, options).points.empty());
}

TEST_CASE("points are the same for any number of threads") {
    const UnitPlanes planes{Mesh(make_built_in_shape("spring", 2000))};
    const TangentialField field(planes, view_function());
    InterestOptions options;
    options.count = 3;
    PointsOfInterest alone;
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        alone = find_points_of_interest(field, k_shell, options);
    }
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    const auto together = find_points_of_interest(field, k_shell, options);
    REQUIRE(alone.points.size() == together.points.size());
    for (std::size_t i = 0; i < alone.points.size(); ++i)
        CHECK(alone.points[i].point == together.points[i].point);
}

TEST_CASE("a climb ends on a peak within its reach") {
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 2000))};
    const TangentialField field(planes, view_function(), {1e-6});
    for (const glm::dvec3& from : tests::probe_points(20, 6)) {
        const PointOfInterest peak = climb(field, k_shell, from, 0.3);
        const glm::dvec3 start = k_shell.nearest(from);
        CHECK(glm::distance(peak.point, start) <= 0.3 + 1e-12);
        CHECK(peak.votes >= field.value(start));
        CHECK(peak.votes == field.value(peak.point));
    }
}

TEST_CASE("progress never falls and a cancelled search says so") {
    const UnitPlanes planes{Mesh(make_built_in_shape("box", 12))};
    const TangentialField field(planes, origin_function());
    double last = 0.0;
    InterestOptions options;
    options.count = 2;
    find_points_of_interest(field, k_ball, options, {{}, [&](double done) {
                                                         CHECK(done >= last);
                                                         CHECK(done <= 1.0);
                                                         last = done;
                                                     }});
    CHECK(last == 1.0);
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(find_points_of_interest(field, k_ball, options, {source.get_token(), {}}),
                    Error);
}

}  // namespace
}  // namespace rimline
