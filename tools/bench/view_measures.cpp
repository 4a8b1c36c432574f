#include "tools/bench/view_measures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>

#include "engine/view_defaults.h"
#include "silhouette/field/best_views.h"
#include "tools/bench/item_buffer.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_measure_px = 256;
constexpr std::uint32_t k_seen_px = 1024;
// Share of the mesh's radius. A surface less far in front of a face's center does not hide it.
constexpr double k_seen_tolerance = 2e-3;
constexpr double k_apart_deg = 20.0;
constexpr double k_middle_radius = 0.5 * (k_view_shell.inner_radius + k_view_shell.outer_radius);
// A field of view that contains the mesh's sphere.
const double k_fov_deg = 2.0 * glm::degrees(std::asin(1.0 / k_middle_radius));

Camera camera_at(const Mesh& mesh, const glm::dvec3& eye) {
    const glm::dvec3 back = glm::normalize(eye - mesh.center());
    const glm::dvec3 up = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return {.eye = eye, .target = mesh.center(), .up = up, .fov_y_deg = k_fov_deg};
}

double entropy_of(const ItemBuffer& buffer, std::vector<std::uint32_t>& counts) {
    std::uint32_t background = 0;
    for (std::uint32_t y = 0; y < buffer.height(); ++y)
        for (std::uint32_t x = 0; x < buffer.width(); ++x) {
            const FaceId face = buffer.face(x, y);
            ++(face == k_no_face ? background : counts[index(face)]);
        }
    const double all = double(buffer.width()) * buffer.height();
    const auto part = [&](std::uint32_t pixels) {
        const double share = pixels / all;
        return pixels > 0 ? -share * std::log2(share) : 0.0;
    };
    double entropy = part(background);
    for (std::uint32_t& pixels : counts) {
        entropy += part(pixels);
        pixels = 0;
    }
    return entropy;
}

}  // namespace

std::vector<glm::dvec3> even_directions(std::uint32_t count) {
    std::vector<glm::dvec3> directions;
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
    }
    return directions;
}

ViewMeasures measure_views(const Mesh& mesh, VisibleRatioPass& pass, std::uint32_t candidates,
                           bool with_seen, const Context& context) {
    ViewMeasures measures;
    for (const glm::dvec3& direction : even_directions(candidates))
        measures.eyes.push_back(mesh.center() + k_middle_radius * mesh.radius() * direction);
    for (const VisibleRatio& ratio : pass.measure(measures.eyes, {context.stop, {}}))
        measures.silhouette.push_back(ratio.visible_pixels);
    measures.area.resize(candidates);
    measures.entropy.resize(candidates);
    measures.seen.resize(with_seen ? candidates : 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates), [&](const auto& range) {
        std::vector<std::uint32_t> counts(mesh.face_count(), 0);
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (context.stop.stop_requested()) return;
            const ItemBuffer buffer(mesh, camera_at(mesh, measures.eyes[i]), k_measure_px,
                                    k_measure_px);
            measures.area[i] = buffer.covered_pixels();
            measures.entropy[i] = entropy_of(buffer, counts);
            if (with_seen) measures.seen[i] = faces_seen(mesh, measures.eyes[i]);
        }
    });
    context.checkpoint();
    return measures;
}

std::vector<bool> faces_seen(const Mesh& mesh, const glm::dvec3& eye) {
    const ItemBuffer buffer(mesh, camera_at(mesh, eye), k_seen_px, k_seen_px);
    std::vector<bool> seen(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        glm::dvec3 middle(0.0);
        for (const VertexId corner : mesh.triangles()[f])
            middle += glm::dvec3(mesh.positions()[index(corner)]) / 3.0;
        seen[f] = buffer.sees(middle, k_seen_tolerance * mesh.radius());
    }
    return seen;
}

std::vector<std::size_t> best_apart(const Mesh& mesh, const std::vector<glm::dvec3>& eyes,
                                    const std::vector<double>& measure, std::size_t count) {
    const double cosine = std::cos(glm::radians(k_apart_deg));
    const auto is_near = [&](std::size_t a, std::size_t b) {
        return glm::dot(glm::normalize(eyes[a] - mesh.center()),
                        glm::normalize(eyes[b] - mesh.center())) > cosine;
    };
    std::vector<std::size_t> order(eyes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return measure[i]; });
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < order.size() && chosen.size() < count; ++i)
        if (std::none_of(order.begin(), order.begin() + std::ptrdiff_t(i),
                         [&](std::size_t better) { return is_near(better, order[i]); }))
            chosen.push_back(order[i]);
    for (std::size_t i = 0; i < order.size() && chosen.size() < count; ++i)
        if (std::ranges::none_of(chosen, [&](std::size_t c) { return is_near(c, order[i]); }))
            chosen.push_back(order[i]);
    return chosen;
}

std::vector<std::size_t> greedy_coverage(const ViewMeasures& measures, std::size_t count) {
    std::vector<std::size_t> chosen;
    std::vector<bool> seen(measures.seen.empty() ? 0 : measures.seen[0].size(), false);
    while (chosen.size() < std::min(count, measures.seen.size())) {
        std::size_t best = 0;
        std::size_t most = 0;
        for (std::size_t i = 0; i < measures.seen.size(); ++i) {
            std::size_t fresh = 0;
            for (std::size_t f = 0; f < seen.size(); ++f) fresh += measures.seen[i][f] && !seen[f];
            if (fresh > most) {
                most = fresh;
                best = i;
            }
        }
        chosen.push_back(best);
        for (std::size_t f = 0; f < seen.size(); ++f)
            if (measures.seen[best][f]) seen[f] = true;
    }
    return chosen;
}

}  // namespace rimline::tools
