#include "tools/bench_points.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/points/point_surface.h"
#include "tools/gap_rule.h"
#include "tools/point_truth.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr double k_wrong_deg = 60.0;
constexpr int k_thresholds_deg[] = {90, 120, 150, 180};

PointsBenchResult::Kind kind_of(const PointTruth& truth) {
    using Kind = PointsBenchResult::Kind;
    if (!truth.is_fit) return Kind::unfit;
    if (truth.is_open()) return truth.is_wide() ? Kind::wide : Kind::open;
    return truth.is_smooth() ? Kind::smooth : Kind::closed;
}

template <typename IsBorder>
BorderCount count(std::string method, const PointTruth& truth, IsBorder&& is_border) {
    BorderCount result{std::move(method)};
    for (std::uint32_t i = 0; i < truth.positions.size(); ++i) {
        const bool found = is_border(i);
        result.missed += truth.is_border[i] && !found;
        result.extra += !truth.is_border[i] && found;
    }
    return result;
}

void measure_normals(const PointSurface& surface, const PointTruth& truth,
                     PointsBenchResult& result) {
    std::vector<double> errors;
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const glm::dvec3 normal = surface.normal(PointId{i});
        if (normal == glm::dvec3(0.0) || truth.normals[i] == glm::dvec3(0.0)) continue;
        errors.push_back(std::atan2(glm::length(glm::cross(normal, truth.normals[i])),
                                    std::abs(glm::dot(normal, truth.normals[i]))) /
                         k_degree);
        result.wrong_normals += errors.back() > k_wrong_deg;
    }
    if (errors.empty()) return;
    std::sort(errors.begin(), errors.end());
    result.median_error_deg = errors[errors.size() / 2];
    result.high_error_deg = errors[errors.size() * 99 / 100];
}

}  // namespace

bool PointsBenchResult::is_found(std::size_t n) const {
    if (border == 0) {
        const bool is_fandisk = std::filesystem::path(model).stem() == "fandisk";
        return counts[n].extra <= (is_fandisk ? 0u : 10u);
    }
    return counts[n].missed <= 0.04 * border && counts[n].extra <= 0.07 * border;
}

PointsBenchResult bench_points(const std::string& model, const Mesh& mesh, const Context& context) {
    PointsBenchResult result;
    result.model = model;
    const PointTruth truth = point_truth(mesh);
    result.kind = kind_of(truth);
    result.points = static_cast<std::uint32_t>(truth.positions.size());
    result.border = truth.border_count;
    if (result.kind == PointsBenchResult::Kind::unfit) return result;

    Progress progress(context, "finding umbrellas of " + model);
    const LongCall call = progress.call();
    const auto labels = [&](const PointSurface& surface) {
        return
            [&surface](std::uint32_t i) { return surface.label(PointId{i}) == PointLabel::border; };
    };
    const PointSurface surface(truth.positions, {}, {call.stop, {}});
    result.counts.push_back(count("robust", truth, labels(surface)));
    result.feature = surface.count(PointLabel::feature);
    result.undecided = surface.count(PointLabel::undecided);
    measure_normals(surface, truth, result);
    result.silhouettes = compare_silhouettes(mesh, surface, {call.stop, {}});
    PointSurfaceOptions thesis;
    thesis.method = PointSurfaceOptions::Method::thesis;
    const PointSurface by_thesis(truth.positions, thesis, {call.stop, {}});
    result.counts.push_back(count("thesis", truth, labels(by_thesis)));
    const std::vector<double> widest = widest_sectors(truth.positions);
    for (const int threshold : k_thresholds_deg)
        result.counts.push_back(
            count("gap " + std::to_string(threshold), truth, [&](std::uint32_t i) {
                // A straight border's sector is 180 degrees but for rounding.
                return widest[i] > threshold * k_degree - 1e-9;
            }));

    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (int round = 0; round < 3; ++round) {
        const auto start = std::chrono::steady_clock::now();
        const PointSurface timed(truth.positions, {}, {call.stop, {}});
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        result.points_per_second = std::max(result.points_per_second, result.points / seconds);
    }
    return result;
}

}  // namespace rimline::tools
