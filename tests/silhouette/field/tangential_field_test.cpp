#include "silhouette/field/tangential_field.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/field/reference_sum.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

using Weight = FieldOptions::Weight;

TEST_CASE("a field is within its bound of the sum over all planes") {
    const auto points = tests::probe_points(100, 1);
    for (const auto& [shape, faces] :
         {std::pair<const char*, std::uint32_t>{"knot", 3000}, {"box", 12}, {"scene", 2000}}) {
        const UnitPlanes planes{Mesh(make_built_in_shape(shape, faces))};
        for (const NamedFunction& named : named_functions())
            for (const Weight weight : {Weight::count, Weight::area})
                for (const double tolerance : {0.0, 1e-6, 1e-4, 1e-2}) {
                    CAPTURE(shape);
                    CAPTURE(named.name);
                    CAPTURE(tolerance);
                    const TangentialField field(planes, named.function, {tolerance, weight});
                    CHECK(field.error_bound() <= (tolerance + 1e-5) * field.max_value());
                    for (const glm::dvec3& p : points)
                        CHECK(std::abs(field.value(p) -
                                       tests::reference_sum(planes, named.function, weight, p)) <=
                              field.error_bound());
                }
    }
}

TEST_CASE("bounds hold on every instruction set") {
    const auto points = tests::probe_points(60, 7);
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 5000))};
    // More pieces than a register holds, and fewer.
    TangentialFunction wavy({{-3.0, 0.0}, {3.0, 0.0}});
    for (double at = -2.5; at < 2.5; at += 0.8)
        wavy = wavy + TangentialFunction({{at, 0.0}, {at + 0.15, 1.0}, {at + 0.3, 0.0}});
    std::uint32_t sets = 0;
    tests::for_each_instruction_set([&](const std::string& set) {
        CAPTURE(set);
        ++sets;
        for (const TangentialFunction& f : {origin_function(), wavy})
            for (const double tolerance : {0.0, 1e-3}) {
                const TangentialField field(planes, f, {tolerance, Weight::area});
                DiscountedField discounted(field);
                discounted.discount(points[5]);
                for (const glm::dvec3& p : points) {
                    CHECK(std::abs(field.value(p) -
                                   tests::reference_sum(planes, f, Weight::area, p)) <=
                          field.error_bound());
                    CHECK(std::abs(discounted.value(p) - tests::reference_discounted(
                                                             planes, f, Weight::area, {{points[5]}},
                                                             p)) <= field.error_bound());
                }
            }
    });
    CHECK(sets >= 2);  // Scalar code is there on every machine.
}

TEST_CASE("many values are those of single calls for any number of threads") {
    const UnitPlanes planes{Mesh(make_built_in_shape("torus", 3000))};
    const TangentialField field(planes, origin_function());
    const auto points = tests::probe_points(1000, 2);
    std::vector<double> alone(points.size());
    std::vector<double> together(points.size());
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        field.values(points, alone);
    }
    {
        const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
        field.values(points, together);
    }
    CHECK(alone == together);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(field.value(points[i]) == alone[i]);
}

TEST_CASE("the gradient is the values' derivative") {
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 1000))};
    for (const TangentialFunction& f : {origin_function(), view_function(), light_function()}) {
        const TangentialField field(planes, f, {0.0, Weight::area});
        const auto value = [&](const glm::dvec3& p) {
            return tests::reference_sum(planes, f, Weight::area, p);
        };
        for (const glm::dvec3& p : tests::probe_points(40, 3)) {
            const double h = 1e-5;
            const glm::dvec3 expected =
                glm::dvec3(value(p + glm::dvec3(h, 0, 0)) - value(p - glm::dvec3(h, 0, 0)),
                           value(p + glm::dvec3(0, h, 0)) - value(p - glm::dvec3(0, h, 0)),
                           value(p + glm::dvec3(0, 0, h)) - value(p - glm::dvec3(0, 0, h))) /
                (2.0 * h);
            CHECK(glm::distance(field.gradient(p), expected) < 1e-5 * field.max_value());
        }
    }
}

TEST_CASE("fields of no plane and of one are defined") {
    const TangentialField none(UnitPlanes(Mesh(MeshSource{})), origin_function());
    CHECK(none.value({1, 2, 3}) == 0.0);
    CHECK(none.gradient({1, 2, 3}) == glm::dvec3(0.0));
    CHECK(none.error_bound() == 0.0);

    MeshSource one{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
    const UnitPlanes planes{Mesh(one)};
    const TangentialField field(planes, origin_function());
    CHECK(field.value({0, 0, 0.5}) == doctest::Approx(1.0));
    CHECK(field.value({0.3, 0, 0}) == doctest::Approx(0.0));
}

TEST_CASE("a cancelled call says so") {
    const UnitPlanes planes{Mesh(make_built_in_shape("box", 12))};
    const TangentialField field(planes, origin_function());
    std::stop_source source;
    source.request_stop();
    std::vector<double> out(1);
    const std::vector<glm::dvec3> points(1);
    CHECK_THROWS_AS(field.values(points, out, {source.get_token(), {}}), Error);
}

}  // namespace
}  // namespace rimline
