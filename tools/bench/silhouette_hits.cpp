#include "tools/bench/silhouette_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/points/point_silhouette.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_viewpoints = 16;
constexpr double k_radii = 2.5;
constexpr double k_never = 2.0;  // No |n·v| is greater.

using Flags = std::vector<std::uint8_t>;

// The set entries and their neighbors.
Flags widened(const Mesh& mesh, const Flags& flags) {
    Flags wide = flags;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto [a, b] = mesh.edge(EdgeId{e}).vertices;
        wide[index(a)] |= flags[index(b)];
        wide[index(b)] |= flags[index(a)];
    }
    return wide;
}

Flags true_vertices(const Mesh& mesh, const HomogeneousPoint& eye) {
    Flags flags(mesh.vertex_count(), 0);
    for (const EdgeId edge : brute_force_silhouette(mesh, eye))
        for (const VertexId vertex : mesh.edge(edge).vertices) flags[index(vertex)] = 1;
    return flags;
}

SilhouetteHits count(const Mesh& mesh, const Flags& found, const Flags& truth,
                     const Flags& wide_truth) {
    const Flags wide_found = widened(mesh, found);
    SilhouetteHits hits;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        hits.truth += truth[v];
        hits.found += found[v];
        hits.hits += truth[v] & found[v];
        hits.near_found += found[v] & wide_truth[v];
        hits.near_truth += truth[v] & wide_found[v];
    }
    return hits;
}

void add(SilhouetteHits& sum, const SilhouetteHits& hits) {
    sum.truth += hits.truth;
    sum.found += hits.found;
    sum.hits += hits.hits;
    sum.near_found += hits.near_found;
    sum.near_truth += hits.near_truth;
}

// The number of the first threshold above a value; the number of thresholds if none.
std::uint32_t first_above(double value) {
    std::uint32_t number = 0;
    while (number < k_threshold_count && !(value < threshold(number))) ++number;
    return number;
}

// All thresholds at once: a vertex counts for each threshold above its value.
std::vector<SilhouetteHits> count_thresholds(const Mesh& mesh, const std::vector<double>& values,
                                             const Flags& truth, const Flags& wide_truth) {
    std::vector<double> least = values;  // The least value of a vertex and its neighbors.
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto [a, b] = mesh.edge(EdgeId{e}).vertices;
        least[index(a)] = std::min(least[index(a)], values[index(b)]);
        least[index(b)] = std::min(least[index(b)], values[index(a)]);
    }
    std::vector<SilhouetteHits> hits(k_threshold_count + 1);
    std::uint64_t all_truth = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        SilhouetteHits& own = hits[first_above(values[v])];
        ++own.found;
        own.hits += truth[v];
        own.near_found += wide_truth[v];
        hits[first_above(least[v])].near_truth += truth[v];
        all_truth += truth[v];
    }
    hits.pop_back();
    for (std::uint32_t t = 1; t < k_threshold_count; ++t) add(hits[t], hits[t - 1]);
    for (SilhouetteHits& at : hits) at.truth = all_truth;
    return hits;
}

}  // namespace

double threshold(std::uint32_t number) { return 0.002 * std::exp2(0.25 * number); }

SilhouetteComparison compare_silhouettes(const Mesh& mesh, const PointSurface& surface,
                                         const LongCall& call) {
    RIMLINE_CHECK(surface.size() == mesh.vertex_count());
    SilhouetteComparison result;
    result.thresholds.resize(k_threshold_count);
    const UmbrellaIndex umbrellas(surface, {call.stop, {}});
    for (const HomogeneousPoint& direction : spread_directions(k_viewpoints)) {
        call.checkpoint(0.0);
        const glm::vec3 eye(mesh.center() +
                            k_radii * mesh.radius() * glm::normalize(glm::dvec3(direction.xyz())));
        const Flags truth = true_vertices(mesh, HomogeneousPoint::viewpoint(eye));
        const Flags wide_truth = widened(mesh, truth);
        Flags found(mesh.vertex_count(), 0);
        const PointSilhouette silhouette(umbrellas, umbrellas.viewpoint(glm::dvec3(eye)));
        for (const PointId p : silhouette.points()) found[index(p)] = 1;
        add(result.umbrellas, count(mesh, found, truth, wide_truth));

        std::vector<double> values(mesh.vertex_count(), k_never);
        for (std::uint32_t v = 0; v < surface.size(); ++v) {
            const glm::dvec3 to = glm::dvec3(eye) - surface.positions()[v];
            const glm::dvec3 normal = surface.normal(PointId{v});
            if (normal != glm::dvec3(0.0) && to != glm::dvec3(0.0))
                values[v] = std::abs(glm::dot(normal, glm::normalize(to)));
        }
        const std::vector<SilhouetteHits> by_threshold =
            count_thresholds(mesh, values, truth, wide_truth);
        for (std::uint32_t t = 0; t < k_threshold_count; ++t)
            add(result.thresholds[t], by_threshold[t]);
    }
    return result;
}

std::uint32_t best_threshold(const std::vector<ComparedModel>& models) {
    std::array<double, k_threshold_count> scores{};
    for (const ComparedModel& model : models)
        for (std::uint32_t t = 0; t < k_threshold_count; ++t)
            scores[t] += model.silhouettes->thresholds[t].score();
    return static_cast<std::uint32_t>(std::ranges::max_element(scores) - scores.begin());
}

}  // namespace rimline::tools
