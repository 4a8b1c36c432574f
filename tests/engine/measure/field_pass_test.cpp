#include "engine/measure/field_pass.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <vector>

#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/models.h"
#include "tests/silhouette/field/reference_sum.h"

namespace rimline {
namespace {

using Weight = FieldOptions::Weight;

std::vector<double> values_of(FieldPass& pass, std::span<const glm::dvec3> points) {
    std::vector<double> values(points.size());
    pass.values(points, values);
    return values;
}

std::vector<glm::dvec3> near_points(std::uint32_t count, std::uint32_t seed) {
    std::vector<glm::dvec3> points = tests::probe_points(2 * count, seed);
    std::erase_if(points, [](const glm::dvec3& p) { return glm::dot(p, p) > 16.0; });
    REQUIRE(points.size() >= count);
    points.resize(count);
    return points;
}

void check_values(const DeviceContext& context, const UnitPlanes& planes,
                  std::span<const glm::dvec3> points) {
    for (const NamedFunction& named : named_functions())
        for (const Weight weight : {Weight::count, Weight::area}) {
            CAPTURE(named.name);
            FieldPass pass(context, planes, named.function, weight);
            const TangentialField field(planes, named.function, {0.0, weight});
            CHECK(pass.error_bound() <= 2e-5 * field.max_value());
            const std::vector<double> values = values_of(pass, points);
            double greatest = 0.0;
            for (std::size_t i = 0; i < points.size(); ++i)
                greatest = std::max(
                    greatest, std::abs(values[i] - tests::reference_sum(planes, named.function,
                                                                        weight, points[i])));
            CHECK(greatest <= pass.error_bound());
        }
}

TEST_CASE("the GPU's field is within its bound of the sum over all planes") {
    RIMLINE_OPEN_GPU(gpu);
    const auto points = near_points(100, 1);
    // Fewer planes than a tile holds, a tile and a bit, and several chunks, the last not full.
    for (const auto& [shape, faces] : {std::pair<const char*, std::uint32_t>{"box", 12},
                                       {"sphere", 66},
                                       {"knot", 3000},
                                       {"scene", 5000}}) {
        CAPTURE(shape);
        check_values(gpu->context(), UnitPlanes(Mesh(make_built_in_shape(shape, faces))), points);
    }
}

TEST_CASE("the GPU's field of a real model is within its bound") {
    RIMLINE_OPEN_GPU(gpu);
    const auto path = tests::find_model("fandisk.obj");
    if (!path) RIMLINE_SKIP("fandisk.obj is in no folder of RIMLINE_MODELS");
    const auto points = near_points(50, 3);
    check_values(gpu->context(), UnitPlanes(Mesh(read_mesh_file(*path))), points);
}

TEST_CASE("the GPU's values do not depend on the points beside them, nor on batches") {
    RIMLINE_OPEN_GPU(gpu);
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 20000))};
    FieldPass pass(gpu->context(), planes, view_function());
    // More than a batch, for a batch's sums are a number for each 1,024 planes and each point.
    const auto points = near_points(7500, 5);
    std::vector<double> reports;
    std::vector<double> values(points.size());
    pass.values(points, values, {{}, [&](double done) { reports.push_back(done); }});
    REQUIRE(reports.size() >= 3);
    CHECK(reports.back() == 1.0);
    for (std::size_t i = 0; i < points.size(); i += 521) {
        CAPTURE(i);
        CHECK(values_of(pass, std::span(points).subspan(i, 1)).front() == values[i]);
    }
}

TEST_CASE("a field on the GPU without planes is zero, and without points nothing") {
    RIMLINE_OPEN_GPU(gpu);
    const auto points = near_points(3, 1);
    FieldPass none(gpu->context(), UnitPlanes(Mesh(MeshSource{})), view_function());
    CHECK(values_of(none, points) == std::vector<double>(3, 0.0));
    CHECK(none.error_bound() == 0.0);
    FieldPass pass(gpu->context(), UnitPlanes(Mesh(make_built_in_shape("box", 12))),
                   view_function());
    CHECK(values_of(pass, {}).empty());
}

TEST_CASE("a field on the GPU that is cancelled stops and works the next time") {
    RIMLINE_OPEN_GPU(gpu);
    const UnitPlanes planes{Mesh(make_built_in_shape("knot", 3000))};
    FieldPass pass(gpu->context(), planes, view_function());
    const auto points = near_points(10, 1);
    std::vector<double> values(points.size());
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(pass.values(points, values, {stop.get_token(), {}}), Error);
    CHECK(std::abs(values_of(pass, points)[0] -
                   tests::reference_sum(planes, view_function(), Weight::count, points[0])) <=
          pass.error_bound());
}

}  // namespace
}  // namespace rimline
