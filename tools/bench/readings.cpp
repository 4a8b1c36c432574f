#include "tools/bench/readings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/brute_force.h"
#include "tools/bench/transform_octree.h"
#include "tools/bench/unit_sphere.h"
#include "tools/bench/vertex_clustering.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

void count_box_tests(const Mesh& mesh, const UnitSphere& unit, std::uint32_t viewpoints,
                     const LongCall& call, Readings& readings) {
    LiteralOctreeOptions options;
    options.origin = unit.center;
    const LiteralOctree octree(mesh, options);
    double count = 0.0;
    for (const std::vector<HomogeneousPoint>& points : viewpoints_on_spheres(unit, viewpoints))
        for (const HomogeneousPoint& point : points) {
            call.checkpoint(count / viewpoints);
            for (std::size_t test = 0; test < k_box_tests.size(); ++test)
                readings.boxes[test] +=
                    static_cast<double>(count_boxes(octree, point, k_box_tests[test]).box_checks());
            readings.ebv_first +=
                static_cast<double>(count_boxes(octree, point, BoxTest::exact, true).box_checks());
            count += 1.0;
        }
    for (double& boxes : readings.boxes) boxes /= std::max(count, 1.0);
    readings.ebv_first /= std::max(count, 1.0);
}

class OrbitCounter {
public:
    OrbitCounter(const Mesh& mesh, const UnitSphere& unit) : mesh_(mesh), unit_(unit) {
        using enum PlaneTransform;
        using enum NodeBoxes;
        octrees_.emplace_back(mesh, unit.center, hough, tight);
        octrees_.emplace_back(mesh, unit.center, hough, octants);
        octrees_.emplace_back(mesh, unit.center, dual, tight);
        octrees_.emplace_back(mesh, unit.center, dual, octants);
    }

    OrbitReading count(double radii, double step_degrees, const LongCall& call,
                       std::string& difference) const {
        const Orbit orbit(unit_.center, {0.0, 1.0, 0.0}, radii * unit_.radius);
        const auto frames = static_cast<std::uint32_t>(std::lround(360.0 / step_degrees));
        HomogeneousPoint previous = orbit.viewpoint(0.0);
        std::vector<std::vector<std::uint32_t>> words(octrees_.size(),
                                                      brute_force_face_bits(mesh_, previous));
        std::array<double, 4> boxes{};
        for (std::uint32_t i = 1; i <= frames; ++i) {
            call.checkpoint(0.0);
            const HomogeneousPoint point = orbit.viewpoint(2.0 * std::numbers::pi * i / frames);
            const std::vector<std::uint32_t> truth = brute_force_face_bits(mesh_, point);
            for (std::size_t k = 0; k < octrees_.size(); ++k) {
                boxes[k] +=
                    static_cast<double>(octrees_[k].move(previous, point, words[k]).box_checks());
                if (words[k] != truth && difference.empty())
                    difference =
                        "orbit of " + std::to_string(radii) + " radii, frame " + std::to_string(i);
            }
            previous = point;
        }
        for (double& sum : boxes) sum /= frames;
        return {radii, step_degrees, {boxes[0], boxes[1]}, {boxes[2], boxes[3]}};
    }

private:
    const Mesh& mesh_;
    UnitSphere unit_;
    std::vector<TransformOctree> octrees_;
};

}  // namespace

Readings bench_readings(const std::string& model, const Mesh& mesh, const ReadingOptions& options,
                        const Context& context) {
    if (mesh.face_count() > options.max_faces) {
        ReadingOptions rest = options;
        rest.max_faces = 0xffffffffu;
        const Mesh coarse(cluster_vertices(mesh, options.max_faces));
        return bench_readings(model, coarse, rest, context);
    }
    Readings readings;
    readings.model = model;
    readings.faces = mesh.face_count();
    const UnitSphere unit = unit_sphere(mesh);
    Progress progress(context, "counting " + model);
    const LongCall call = progress.call();
    count_box_tests(mesh, unit, options.viewpoints, call.part(0.0, 0.5), readings);
    const OrbitCounter counter(mesh, unit);
    for (const double radii : options.radii)
        for (const double step : options.steps_degrees)
            readings.orbits.push_back(counter.count(radii, step, call, readings.difference));
    return readings;
}

void print_result(const Readings& readings) {
    std::printf("%s: %u faces\n  box checks of an extraction, by test:", readings.model.c_str(),
                readings.faces);
    for (std::size_t i = 0; i < k_box_tests.size(); ++i)
        std::printf(" %s %.0f,", std::string(name_of(k_box_tests[i])).c_str(), readings.boxes[i]);
    std::printf(" EBV first %.0f\n", readings.ebv_first);
    std::printf("  box checks of a frame around the model\n");
    std::printf("  %6s %6s %10s %10s %6s %14s %14s %6s\n", "radii", "step", "Hough", "dual",
                "ratio", "Hough, octants", "dual, octants", "ratio");
    for (const OrbitReading& orbit : readings.orbits)
        std::printf("  %6.2f %6.1f %10.0f %10.0f %6.2f %14.0f %14.0f %6.2f\n", orbit.radii,
                    orbit.step_degrees, orbit.hough[0], orbit.dual[0],
                    orbit.dual[0] / orbit.hough[0], orbit.hough[1], orbit.dual[1],
                    orbit.dual[1] / orbit.hough[1]);
    std::printf("\n");
}

nlohmann::ordered_json to_json(const Readings& readings) {
    nlohmann::ordered_json tests;
    for (std::size_t i = 0; i < k_box_tests.size(); ++i)
        tests[std::string(name_of(k_box_tests[i]))] = readings.boxes[i];
    tests["ebv_first"] = readings.ebv_first;
    nlohmann::ordered_json orbits = nlohmann::ordered_json::array();
    for (const OrbitReading& orbit : readings.orbits)
        orbits.push_back({{"radii", orbit.radii},
                          {"step_degrees", orbit.step_degrees},
                          {"hough", orbit.hough[0]},
                          {"dual", orbit.dual[0]},
                          {"hough_octants", orbit.hough[1]},
                          {"dual_octants", orbit.dual[1]}});
    return {{"model", readings.model},
            {"faces", readings.faces},
            {"verified", readings.difference.empty()},
            {"box_tests", std::move(tests)},
            {"orbits", std::move(orbits)}};
}

}  // namespace rimline::tools
