#include "tools/bench/figures.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/bench/quiet_context.h"

using namespace rimline;
using tools::bench_figures;
using tools::ExtractionWork;
using tools::FigureData;
using tools::FigureOptions;
using tools::OrbitWork;
using tools::PointSpread;

namespace {

FigureOptions few() {
    FigureOptions options;
    options.viewpoints = 29;
    options.frames = 12;
    options.random_points = 3;
    options.resolutions = {500, 1000};
    options.sample = 50;
    return options;
}

std::uint32_t total(const std::vector<std::uint32_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), 0u);
}

}  // namespace

TEST_CASE("figures count every requested point, frame and viewpoint") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const FigureData data = bench_figures("knot", mesh, few(), tools::k_quiet);
    CHECK(data.difference == "");
    CHECK(data.faces == mesh.face_count());
    for (const PointSpread* spread : {&data.hough, &data.dual}) {
        CHECK(spread->points + spread->left_out == mesh.face_count());
        CHECK(total(spread->distances) == spread->points);
        CHECK(spread->percentile_99 <= spread->farthest);
        CHECK(spread->sample.size() == 50);
        CHECK(total(spread->leaf_depths) <= spread->points);
        CHECK(total(spread->leaf_depths) > spread->points / 2);
    }
    REQUIRE(data.extraction.size() == 3);
    CHECK(data.extraction[0].points == 2);
    CHECK(data.extraction[1].points == 8);
    CHECK(data.extraction[2].points == 19);
    for (const OrbitWork::Counts* counts :
         {&data.orbit.full, &data.orbit.incremental, &data.orbit.as_written, &data.orbit.dual,
          &data.orbit.full_octants, &data.orbit.dual_octants, &data.orbit.index}) {
        CHECK(counts->boxes.size() == 12);
        CHECK(counts->faces.size() == 12);
        CHECK(total(counts->boxes) > 0);
    }
    REQUIRE(data.resolutions.size() == 3);
    CHECK(data.resolutions[0].faces <= 500);
    CHECK(data.resolutions[1].faces <= 1000);
    CHECK(data.resolutions[2].faces == mesh.face_count());
}

TEST_CASE("counts keep the order that their meanings give them") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const FigureData data = bench_figures("knot", mesh, few(), tools::k_quiet);
    for (const ExtractionWork& work : data.extraction) {
        CHECK(work.silhouette > 0.0);
        // An EBV is tested only where the PBV does not exclude the node. Boxes of leaves are added.
        CHECK(work.literal_boxes[1] <= work.literal_boxes[0]);
        CHECK(work.literal_all_boxes[0] > work.literal_boxes[0]);
        CHECK(work.index_boxes < work.literal_boxes[0] + work.literal_boxes[1]);
    }
    for (std::size_t i = 0; i < data.orbit.turned.size(); ++i) {
        CHECK(data.orbit.above_candidates[i] < data.orbit.full.boxes[i]);
        CHECK(data.orbit.full_octants.boxes[i] >= data.orbit.full.boxes[i]);
        CHECK(data.orbit.dual_octants.boxes[i] >= data.orbit.dual.boxes[i]);
        CHECK(data.orbit.full.faces[i] + data.orbit.contained[i] >= data.orbit.turned[i]);
    }
}

TEST_CASE("planes that touch a sphere have Hough and dual points at distance one") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    const FigureData data = bench_figures("sphere", mesh, few(), tools::k_quiet);
    CHECK(data.unit.radius == doctest::Approx(mesh.radius()).epsilon(1e-3));
    CHECK(data.hough.farthest == doctest::Approx(1.0).epsilon(1e-2));
    CHECK(data.dual.farthest == doctest::Approx(1.0).epsilon(1e-2));
    CHECK(data.sfo_edges == 0);
}

TEST_CASE("a mesh of more faces than requested is clustered first") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    FigureOptions options = few();
    options.max_faces = 800;
    const FigureData data = bench_figures("knot", mesh, options, tools::k_quiet);
    CHECK(data.faces <= 800);
    CHECK(data.resolutions.size() == 2);
}

TEST_CASE("a mesh without faces has figures of nothing, and figures are JSON") {
    const FigureData nothing = bench_figures("none", Mesh(MeshSource{}), few(), tools::k_quiet);
    CHECK(nothing.difference == "");
    CHECK(nothing.hough.points == 0);
    CHECK(total(nothing.orbit.full.boxes) == 0);

    const Mesh mesh(make_built_in_shape("torus", 800));
    const nlohmann::ordered_json json =
        to_json(bench_figures("torus", mesh, few(), tools::k_quiet));
    CHECK(json["verified"] == true);
    CHECK(json["extraction"].size() == 3);
    CHECK(json["orbit"]["dual"]["boxes"].size() == 12);
    CHECK(json["hough"]["sample"][0].size() == 3);
    CHECK(json["layout"]["boxes"].size() > 0);
}
