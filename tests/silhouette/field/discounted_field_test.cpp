#include "silhouette/field/discounted_field.h"

#include <doctest/doctest.h>

#include <cmath>

#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/field/reference_sum.h"

namespace rimline {
namespace {

using Weight = FieldOptions::Weight;

TEST_CASE("discounted votes are within their bound of the sum over all planes" *
          doctest::test_suite("plain")) {
    const std::vector<glm::dvec3> chosen = {{0.7, 0.4, -0.3}, {-1.1, 0.2, 0.9}, {0.0, -1.9, 0.1}};
    const auto points = tests::probe_points(100, 4);
    for (const auto& [shape, faces] :
         {std::pair<const char*, std::uint32_t>{"knot", 3000}, {"box", 12}, {"scene", 2000}}) {
        const UnitPlanes planes{Mesh(make_built_in_shape(shape, faces))};
        for (const TangentialFunction& f :
             {origin_function(), view_function(), light_function(), view_function() * -1.0})
            for (const Weight weight : {Weight::count, Weight::area})
                for (const double tolerance : {0.0, 1e-4, 1e-2}) {
                    CAPTURE(shape);
                    CAPTURE(tolerance);
                    const TangentialField field(planes, f, {tolerance, weight});
                    DiscountedField discounted(field);
                    for (const glm::dvec3& p : points) CHECK(discounted.value(p) == field.value(p));
                    for (std::size_t k = 1; k <= chosen.size(); ++k) {
                        discounted.discount(chosen[k - 1]);
                        for (const glm::dvec3& p : points)
                            CHECK(std::abs(discounted.value(p) -
                                           tests::reference_discounted(
                                               planes, f, weight, std::span(chosen).first(k), p)) <=
                                  discounted.error_bound());
                    }
                    for (const glm::dvec3& c : chosen)
                        CHECK(discounted.value(c) <= discounted.error_bound());
                }
    }
}

TEST_CASE("many discounted values are those of single calls") {
    const UnitPlanes planes{Mesh(make_built_in_shape("torus", 3000))};
    const TangentialField field(planes, origin_function());
    DiscountedField discounted(field);
    discounted.discount({0.5, 0.5, 0.5});
    const auto points = tests::probe_points(500, 5);
    std::vector<double> values(points.size());
    discounted.values(points, values);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(discounted.value(points[i]) == values[i]);
}

TEST_CASE("less exact values are within so many tolerances, those of a field with that tolerance") {
    const UnitPlanes planes{Mesh(make_built_in_shape("torus", 3000))};
    const TangentialField fine(planes, origin_function(), {2e-3}),
        coarse(planes, origin_function(), {8e-3});
    const auto points = tests::probe_points(500, 5);
    std::vector<double> exact(points.size()), less_exact(points.size()), expected(points.size());
    for (const bool is_discounted : {false, true}) {
        DiscountedField of_fine(fine), of_coarse(coarse);
        if (is_discounted) of_fine.discount(points[0]), of_coarse.discount(points[0]);
        of_fine.values(points, exact);
        of_fine.values(points, less_exact, {}, 4.0);
        of_coarse.values(points, expected);
        CHECK(less_exact == expected);
        CHECK(less_exact != exact);
    }
}

}  // namespace
}  // namespace rimline
