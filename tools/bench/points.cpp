#include "tools/bench/points.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/feature_weights.h"
#include "silhouette/points/point_surface.h"
#include "tools/bench/even_samples.h"
#include "tools/bench/gap_rule.h"
#include "tools/bench/library_borders.h"
#include "tools/bench/point_truth.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr double k_wrong_deg = 60.0;
constexpr std::uint32_t k_max_extra = 10;  // For closed models.
constexpr double k_sharp_rad = 40.0 * k_degree, k_blunt_rad = 25.0 * k_degree;
constexpr float k_heavy = 0.4f;
constexpr int k_thresholds_deg[] = {90, 120, 150, 180};

PointsBenchResult::Kind kind_of(const PointTruth& truth) {
    using Kind = PointsBenchResult::Kind;
    if (!truth.is_fit) return Kind::unfit;
    if (truth.is_open()) return truth.is_wide() ? Kind::wide : Kind::open;
    return truth.is_smooth() ? Kind::smooth : Kind::closed;
}

void add_noise(PointTruth& truth, double noise) {
    const std::vector<glm::dvec3> exact = truth.positions;
    std::mt19937 random(1);
    std::normal_distribution<double> gauss;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        if (truth.neighbors[i].empty()) continue;
        double lengths = 0.0;
        for (const std::uint32_t n : truth.neighbors[i])
            lengths += glm::distance(exact[i], exact[n]);
        const double spacing = lengths / static_cast<double>(truth.neighbors[i].size());
        for (int axis = 0; axis < 3; ++axis)
            truth.positions[i][axis] += noise * spacing * gauss(random);
    }
}

CreaseCount count_creases(std::string method, const PointSurface& surface, const PointTruth& truth,
                          const LongCall& call) {
    CreaseCount count{std::move(method)};
    const std::vector<float> weights = feature_weights(surface, call);
    const auto is_on = [&](std::uint32_t i) { return truth.turns[i] > k_sharp_rad; };
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const bool is_labeled = surface.label(PointId{i}) == PointLabel::feature;
        if (is_on(i)) {
            ++count.on;
            count.labeled += is_labeled;
        } else if (std::ranges::any_of(truth.neighbors[i], is_on)) {
            ++count.beside;
            count.heavy += weights[i] > k_heavy;
        }
        count.extra += is_labeled && truth.turns[i] < k_blunt_rad;
    }
    return count;
}

void measure_normals(const Mesh& mesh, const PointSurface& surface, const PointTruth& truth,
                     PointsBenchResult& result) {
    // The angle to the nearest of a point's normals.
    const auto error_deg = [&](std::uint32_t i, const glm::dvec3& truly) {
        double least = 180.0;
        const PointSurface::UmbrellaRange range = surface.umbrellas_of(PointId{i});
        for (std::uint32_t u = range.first; u < range.last; ++u) {
            const double error =
                angle_between(surface.umbrella(UmbrellaId{u}).normal, truly) / k_degree;
            least = std::min({least, error, 180.0 - error});
        }
        return least;
    };
    // Of the faces at each point the nearest and the farthest.
    std::vector<double> least(surface.size(), 180.0), greatest(surface.size(), 0.0);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (const VertexId v : mesh.triangles()[f]) {
            const double error = error_deg(index(v), mesh.plane(FaceId{f}).normal());
            least[index(v)] = std::min(least[index(v)], error);
            greatest[index(v)] = std::max(greatest[index(v)], error);
        }
    std::vector<double> errors;
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        if (surface.normal(PointId{i}) == glm::dvec3(0.0) || truth.normals[i] == glm::dvec3(0.0))
            continue;
        errors.push_back(surface.label(PointId{i}) == PointLabel::feature
                             ? greatest[i]
                             : error_deg(i, truth.normals[i]));
        if (least[i] <= k_wrong_deg) continue;
        ++result.wrong_normals;
        result.wrong_apart += !truth.is_crowded(i);
    }
    if (errors.empty()) return;
    std::sort(errors.begin(), errors.end());
    result.median_error_deg = errors[errors.size() / 2];
    result.high_error_deg = errors[errors.size() * 99 / 100];
}

}  // namespace

std::uint32_t PointsBenchResult::extra_allowed() const {
    return std::filesystem::path(model).stem() == "fandisk" ? 0 : k_max_extra;
}

std::uint32_t PointsBenchResult::charged(const BorderCount& count) const {
    return extra_allowed() == 0 ? count.extra : count.extra - count.around_holes;
}

bool PointsBenchResult::is_found(const BorderCount& count) const {
    if (border == 0) return charged(count) <= extra_allowed();
    return count.missed <= 0.04 * border && count.extra <= 0.07 * border;
}

PointsBenchResult bench_points(const std::string& model, const Mesh& mesh,
                               const PointsBenchOptions& options, const Context& context) {
    PointsBenchResult result;
    result.model = model;
    PointTruth truth = point_truth(mesh);
    result.kind = kind_of(truth);
    result.points = static_cast<std::uint32_t>(truth.positions.size());
    result.border = truth.border_count;
    result.border_wide = truth.wide_count;
    if (result.kind == PointsBenchResult::Kind::unfit) return result;
    if (options.noise > 0.0) add_noise(truth, options.noise);
    if (options.is_even) {
        EvenSamples samples = even_samples(mesh, result.points);
        truth.positions = std::move(samples.positions);
        truth.is_border = std::move(samples.is_border);
        truth.is_wide_at.assign(truth.positions.size(), 0);
        result.points = static_cast<std::uint32_t>(truth.positions.size());
        result.border =
            static_cast<std::uint32_t>(std::ranges::count(truth.is_border, std::uint8_t{1}));
        result.border_wide = 0;
    }

    Progress progress(context, "finding umbrellas of " + model);
    const LongCall call = progress.call();
    const auto add = [&](std::string method, auto&& is_border) {
        BorderCount count{std::move(method)};
        std::vector<std::uint8_t> found(result.points);
        for (std::uint32_t i = 0; i < result.points; ++i) {
            found[i] = is_border(i);
            count.missed += truth.is_border[i] && !found[i];
            count.missed_wide += truth.is_wide_at[i] && !found[i];
            count.extra += !truth.is_border[i] && found[i];
        }
        if (!options.is_even && result.border == 0 && count.extra > k_max_extra)
            count.around_holes = count_around_holes(mesh, found);
        result.counts.push_back(std::move(count));
    };
    const auto labels = [&](const PointSurface& surface) {
        return
            [&surface](std::uint32_t i) { return surface.label(PointId{i}) == PointLabel::border; };
    };
    const PointSurface surface(truth.positions, {}, {call.stop, {}});
    add("robust", labels(surface));
    result.feature = surface.count(PointLabel::feature);
    result.undecided = surface.count(PointLabel::undecided);
    if (!options.is_even) {
        measure_normals(mesh, surface, truth, result);
        result.silhouettes = compare_silhouettes(mesh, surface, {call.stop, {}});
        result.creases.push_back(count_creases("robust", surface, truth, {call.stop, {}}));
    }
    PointSurfaceOptions thesis;
    thesis.method = PointSurfaceOptions::Method::thesis;
    const PointSurface by_thesis(truth.positions, thesis, {call.stop, {}});
    add("thesis", labels(by_thesis));
    if (!options.is_even)
        result.creases.push_back(count_creases("thesis", by_thesis, truth, {call.stop, {}}));
    const std::vector<double> widest = widest_sectors(truth.positions);
    for (const int threshold : k_thresholds_deg)
        add("gap " + std::to_string(threshold), [&](std::uint32_t i) {
            // The sector of a straight border is 180 degrees, up to rounding.
            return widest[i] > threshold * k_degree - 1e-9;
        });
    for (const LibraryBorders& library : library_borders(truth.positions, context))
        add(library.method, [&](std::uint32_t i) { return library.is_border[i] != 0; });

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
