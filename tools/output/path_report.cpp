#include "tools/output/path_report.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "silhouette/field/steady_ups.h"
#include "tools/options/option_types.h"
#include "tools/output/json_vector.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// Samples of the whole path for min_distance.
constexpr int k_distance_samples = 20'000;
// Least number of eyes along the path for which up axes are computed.
constexpr std::uint32_t k_min_ups = 1440;

using Json = nlohmann::ordered_json;

}  // namespace

void PathPlan::add_to(CLI::App& app) {
    add_count(app, "--frames", frames, 1, 1'000'000,
              "Number of equally spaced camera positions on the path")
        ->group("Path");
}

PathSamples sample_path(const CameraPath& path, const glm::dvec3& center, const glm::dvec3& up,
                        std::uint32_t count) {
    const std::uint32_t each = (k_min_ups + count - 1) / count;
    std::vector<glm::dvec3> eyes;
    for (std::uint32_t i = 0; i < count * each; ++i)
        eyes.push_back(path.position(double(i) / (count * each)));
    const std::vector<glm::dvec3> ups = steady_ups(eyes, center, up);
    PathSamples samples;
    for (std::uint32_t i = 0; i < count; ++i) {
        samples.eyes.push_back(path.position(double(i) / count));
        samples.ups.push_back(ups[i * each]);
    }
    return samples;
}

PlannedPath PathPlan::plan(const ChosenViews& chosen, const glm::dvec3& up,
                           const Context& context) const {
    const auto start = std::chrono::steady_clock::now();
    Progress progress(context, "planning the path");
    std::vector<glm::dvec3> views;
    for (const BestView& view : chosen.best.views) views.push_back(view.eye);
    std::vector<TourNode> nodes = plan_tour(chosen.field, views, progress.call());
    std::vector<glm::dvec3> places;
    for (const TourNode& node : nodes) places.push_back(node.place);
    const glm::dvec3 center = chosen.field.frame().center;
    CameraPath path(center, places);
    PathSamples samples = sample_path(path, center, up, frames);
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& sample : samples.eyes)
        points.push_back(chosen.field.frame().from_model(sample));
    std::vector<double> sample_votes(points.size());
    chosen.field.values(points, sample_votes, {context.stop, {}});
    double min_distance = glm::distance(places[0], center);
    for (int i = 0; i < k_distance_samples; ++i)
        min_distance = std::min(
            min_distance, glm::distance(path.position(double(i) / k_distance_samples), center));
    return {
        .nodes = std::move(nodes),
        .path = std::move(path),
        .samples = std::move(samples.eyes),
        .ups = std::move(samples.ups),
        .sample_votes = std::move(sample_votes),
        .min_distance = min_distance,
        .ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count()};
}

Json path_json(const std::string& model, const Mesh& mesh, const ChosenViews& chosen,
               const PlannedPath& planned) {
    Json nodes = Json::array(), node_views = Json::array(), node_votes = Json::array();
    for (const TourNode& node : planned.nodes) {
        nodes.push_back(json_vector(node.place));
        node_views.push_back(node.view ? Json(*node.view) : Json());
        node_votes.push_back(node.votes);
    }
    Json samples = Json::array(), ups = Json::array();
    for (const glm::dvec3& sample : planned.samples) samples.push_back(json_vector(sample));
    for (const glm::dvec3& up : planned.ups) ups.push_back(json_vector(up));
    return {{"model", model},
            {"nodes", std::move(nodes)},
            {"node_views", std::move(node_views)},
            {"node_votes", std::move(node_votes)},
            {"samples", std::move(samples)},
            {"ups", std::move(ups)},
            {"sample_votes", planned.sample_votes},
            {"min_distance", planned.min_distance},
            {"length", planned.path.length()},
            {"views", to_json(chosen)},
            {"asked", chosen.requested_count},
            {"center", json_vector(mesh.center())},
            {"radius", mesh.radius()},
            {"inside_out", chosen.is_inside_out},
            {"views_ms", chosen.ms},
            {"ms", planned.ms}};
}

void print_path(const std::string& title, const ChosenViews& chosen, const PlannedPath& planned) {
    const double radius = chosen.field.frame().radius;
    std::printf("%s\n", title.c_str());
    print_views(chosen);
    std::printf("  path        %zu nodes, %.3g radii long, never nearer than %.4g radii\n",
                planned.nodes.size(), planned.path.length() / radius,
                planned.min_distance / radius);
    std::printf("  time        %.1f ms for the path\n", planned.ms);
}

}  // namespace rimline::tools
