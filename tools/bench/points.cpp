#include "tools/bench/points.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/feature_weights.h"
#include "silhouette/points/pca_normals.h"
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

// `normals_of(i)` are the normals of point i, which is the vertex `vertices[i]`.
template <typename NormalsOf>
NormalErrors normal_errors(const Mesh& mesh, const PointTruth& truth,
                           std::span<const std::uint32_t> vertices, NormalsOf&& normals_of) {
    // Of the faces at each vertex the nearest and the farthest from the normals.
    constexpr std::size_t k_max_normals = 8;
    struct Point {
        std::array<glm::dvec3, k_max_normals> normals;
        std::size_t count = 0;
        double least = 180.0, greatest = 0.0;

        double error_deg(const glm::dvec3& truly) const {
            double error = 180.0;
            for (std::size_t n = 0; n < count; ++n) {
                const double angle = angle_between(normals[n], truly) / k_degree;
                error = std::min({error, angle, 180.0 - angle});
            }
            return error;
        }
    };
    std::vector<Point> points(truth.positions.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i] == PerturbedPoints::k_none) continue;
        Point& point = points[vertices[i]];
        for (const glm::dvec3& normal : normals_of(i))
            if (normal != glm::dvec3(0.0) && point.count < k_max_normals)
                point.normals[point.count++] = normal;
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (const VertexId v : mesh.triangles()[f]) {
            Point& point = points[index(v)];
            const double error = point.error_deg(mesh.plane(FaceId{f}).normal());
            point.least = std::min(point.least, error);
            point.greatest = std::max(point.greatest, error);
        }
    NormalErrors result;
    std::vector<double> errors;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        if (points[v].count == 0 || truth.normals[v] == glm::dvec3(0.0)) continue;
        errors.push_back(points[v].count > 1 ? points[v].greatest
                                             : points[v].error_deg(truth.normals[v]));
        if (points[v].least <= k_wrong_deg) continue;
        ++result.wrong;
        result.wrong_apart += !truth.is_crowded(v);
    }
    if (errors.empty()) return result;
    std::sort(errors.begin(), errors.end());
    result.median_deg = errors[errors.size() / 2];
    result.high_deg = errors[errors.size() * 99 / 100];
    return result;
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
    const PointTruth truth = point_truth(mesh);
    result.kind = kind_of(truth);
    result.points = static_cast<std::uint32_t>(truth.positions.size());
    result.border = truth.border_count;
    result.border_wide = truth.wide_count;
    if (result.kind == PointsBenchResult::Kind::unfit) return result;
    PerturbedPoints points = perturb(truth, options.perturbation);
    std::vector<std::uint8_t> is_border, is_wide_at;
    if (options.is_even) {
        EvenSamples samples = even_samples(mesh, result.points);
        points.positions = std::move(samples.positions);
        points.vertices.assign(points.positions.size(), PerturbedPoints::k_none);
        is_border = std::move(samples.is_border);
        is_wide_at.assign(is_border.size(), 0);
    } else {
        for (const std::uint32_t v : points.vertices) {
            is_border.push_back(v != PerturbedPoints::k_none && truth.is_border[v]);
            is_wide_at.push_back(v != PerturbedPoints::k_none && truth.is_wide_at[v]);
        }
    }
    const auto count_of = [](const std::vector<std::uint8_t>& flags) {
        return static_cast<std::uint32_t>(std::ranges::count(flags, std::uint8_t{1}));
    };
    result.points = static_cast<std::uint32_t>(points.positions.size());
    result.border = count_of(is_border);
    result.border_wide = count_of(is_wide_at);
    const bool are_vertices = !options.is_even && options.perturbation.keeps_vertices();

    Progress progress(context, "finding umbrellas of " + model);
    const LongCall call = progress.call();
    const auto add = [&](std::string method, auto&& is_found) {
        BorderCount count{std::move(method)};
        std::vector<std::uint8_t> found(result.points);
        for (std::uint32_t i = 0; i < result.points; ++i) {
            found[i] = is_found(i);
            count.missed += is_border[i] && !found[i];
            count.missed_wide += is_wide_at[i] && !found[i];
            count.extra += !is_border[i] && found[i];
        }
        if (are_vertices && result.border == 0 && count.extra > k_max_extra)
            count.around_holes = count_around_holes(mesh, found);
        result.counts.push_back(std::move(count));
    };
    const auto labels = [&](const PointSurface& surface) {
        return
            [&surface](std::uint32_t i) { return surface.label(PointId{i}) == PointLabel::border; };
    };
    using Method = PointSurfaceOptions::Method;
    PointSurfaceOptions robust, thesis;
    thesis.method = Method::thesis;
    (options.surface.method == Method::thesis ? thesis : robust) = options.surface;
    const PointSurface surface(points.positions, robust, {call.stop, {}});
    add("robust", labels(surface));
    result.feature = surface.count(PointLabel::feature);
    result.undecided = surface.count(PointLabel::undecided);
    if (!options.is_even) {
        result.normals = normal_errors(mesh, truth, points.vertices, [&](std::uint32_t i) {
            const auto range = surface.umbrellas_of(PointId{i});
            std::vector<glm::dvec3> normals;
            for (std::uint32_t u = range.first; u < range.last; ++u)
                normals.push_back(surface.umbrella(UmbrellaId{u}).normal);
            return normals;
        });
        const std::vector<glm::dvec3> fitted =
            pca_normals(points.positions, robust.k, {call.stop, {}});
        result.fitted_normals = normal_errors(mesh, truth, points.vertices, [&](std::uint32_t i) {
            return std::span(&fitted[i], 1);
        });
    }
    if (are_vertices) {
        result.silhouettes = compare_silhouettes(mesh, surface, {call.stop, {}});
        result.creases.push_back(count_creases("robust", surface, truth, {call.stop, {}}));
    }
    const PointSurface by_thesis(points.positions, thesis, {call.stop, {}});
    add("thesis", labels(by_thesis));
    if (are_vertices)
        result.creases.push_back(count_creases("thesis", by_thesis, truth, {call.stop, {}}));
    const std::vector<double> widest = widest_sectors(points.positions);
    for (const int threshold : k_thresholds_deg)
        add("gap " + std::to_string(threshold), [&](std::uint32_t i) {
            // The sector of a straight border is 180 degrees, up to rounding.
            return widest[i] > threshold * k_degree - 1e-9;
        });
    if (!options.without_libraries)
        for (const LibraryBorders& library :
             library_borders(points.positions, options.perturbation.is_none(), context))
            add(library.method, [&](std::uint32_t i) { return library.is_border[i] != 0; });

    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (int round = 0; round < 3; ++round) {
        const auto start = std::chrono::steady_clock::now();
        const PointSurface timed(points.positions, robust, {call.stop, {}});
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        result.points_per_second = std::max(result.points_per_second, result.points / seconds);
    }
    return result;
}

}  // namespace rimline::tools
