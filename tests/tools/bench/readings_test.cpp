#include "tools/bench/readings.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/bench/quiet_context.h"
#include "tools/bench/figures.h"

using namespace rimline;
using tools::bench_readings;
using tools::FigureData;
using tools::ReadingOptions;
using tools::Readings;

TEST_CASE("readings at two radii and half a degree are those of the figures") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    ReadingOptions options;
    options.viewpoints = 29;
    options.radii = {1.05, 2.0};
    options.steps_degrees = {30.0};
    const Readings readings = bench_readings("knot", mesh, options, tools::k_quiet);
    CHECK(readings.difference == "");
    CHECK(readings.faces == mesh.face_count());
    REQUIRE(readings.orbits.size() == 2);

    tools::FigureOptions few;
    few.viewpoints = 29;
    few.frames = 12;
    few.resolutions = {};
    const FigureData figures = tools::bench_figures("knot", mesh, few, tools::k_quiet);
    const auto mean = [](const std::vector<std::uint32_t>& counts) {
        double sum = 0.0;
        for (const std::uint32_t count : counts) sum += count;
        return sum / static_cast<double>(counts.size());
    };
    CHECK(readings.orbits[1].hough[0] == doctest::Approx(mean(figures.orbit.full.boxes)));
    CHECK(readings.orbits[1].hough[1] == doctest::Approx(mean(figures.orbit.full_octants.boxes)));
    CHECK(readings.orbits[1].dual[0] == doctest::Approx(mean(figures.orbit.dual.boxes)));
    CHECK(readings.orbits[1].dual[1] == doctest::Approx(mean(figures.orbit.dual_octants.boxes)));
    double boxes = 0.0;
    for (const tools::ExtractionWork& work : figures.extraction)
        boxes += work.points * (work.literal_boxes[0] + work.literal_boxes[1]) / 29.0;
    CHECK(readings.boxes[0] == doctest::Approx(boxes));
    CHECK(readings.ebv_first != readings.boxes[0]);
}

TEST_CASE(
    "readings are of a clustered mesh where it is to have fewer faces and of nothing without") {
    ReadingOptions options;
    options.viewpoints = 14;
    options.radii = {3.0};
    options.steps_degrees = {90.0, 120.0};
    options.max_faces = 500;
    const Mesh mesh(make_built_in_shape("torus", 3000));
    const Readings readings = bench_readings("torus", mesh, options, tools::k_quiet);
    CHECK(readings.faces <= 500);
    const nlohmann::ordered_json json = to_json(readings);
    CHECK(json["verified"] == true);
    CHECK(json["box_tests"]["exact"] == readings.boxes[0]);
    CHECK(json["orbits"].size() == 2);
    const Readings nothing = bench_readings("none", Mesh(MeshSource{}), options, tools::k_quiet);
    CHECK(nothing.difference == "");
    CHECK(nothing.boxes[0] == 0.0);
}
