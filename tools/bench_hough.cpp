#include "tools/bench_hough.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "silhouette/hough/baselines/brute_force.h"
#include "silhouette/hough/baselines/brute_force_packed.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tools/frame_check.h"
#include "tools/progress.h"
#include "tools/track_path.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

// One method of a case: what it does before a round, untimed, and for each point.
struct Method {
    std::string name;
    std::function<void(const HomogeneousPoint&)> prepare;
    std::function<void(const HomogeneousPoint&)> step;
    std::function<TraversalCounters()> counters;  // Of the last step.
};

// Evenly over the sphere, by the golden angle; the radii alternate.
std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count) {
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double across = std::sqrt(1.0 - z * z);
        const glm::dvec3 out(across * std::cos(golden_angle * i),
                             across * std::sin(golden_angle * i), z);
        points.push_back(HomogeneousPoint::viewpoint(
            glm::vec3(mesh.center() + (1.0 + i % 3) * mesh.radius() * out)));
    }
    return points;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void time_methods(CaseResult& result, const std::vector<Method>& methods,
                  const std::vector<HomogeneousPoint>& points, std::uint32_t rounds,
                  const Context& context) {
    std::vector<std::vector<double>> least(
        methods.size(),
        std::vector<double>(points.size(), std::numeric_limits<double>::infinity()));
    std::vector<TraversalCounters> sums(methods.size());
    Progress progress(context, "measuring " + result.name + " of " + result.model);
    const LongCall call = progress.call();
    const double share = 1.0 / (static_cast<double>(methods.size()) * (rounds + 1));
    double done = 0.0;
    for (std::uint32_t round = 0; round <= rounds; ++round) {  // Round 0 warms up.
        for (std::size_t m = 0; m < methods.size(); ++m) {
            call.checkpoint(done);
            done += share;
            methods[m].prepare(points.front());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Clock::time_point start = Clock::now();
                methods[m].step(points[i]);
                const std::chrono::duration<double, std::micro> took = Clock::now() - start;
                if (round == 0)
                    sums[m] += methods[m].counters();
                else
                    least[m][i] = std::min(least[m][i], took.count());
            }
        }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const std::size_t n = points.size();
        double sum = 0.0;
        for (const double us : least[m]) sum += us;
        result.methods.push_back(
            {methods[m].name,
             median(least[m]),
             sum / static_cast<double>(n),
             {sums[m].box_checks / n, sums[m].face_checks / n, sums[m].edge_checks / n}});
    }
}

CaseResult bench_extraction(const std::string& model, const HoughOctree& octree,
                            const HoughBenchOptions& options, const Context& context) {
    const Mesh& mesh = octree.mesh();
    const PackedBruteForce packed(mesh);
    const std::vector<HomogeneousPoint> points = spread_viewpoints(mesh, options.viewpoints);
    CaseResult result{"extraction", model, mesh.face_count(), mesh.edge_count()};

    std::vector<EdgeId> edges;
    std::vector<std::uint32_t> words;
    TraversalCounters counters;
    double size = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        context.checkpoint();
        const std::vector<EdgeId> truth = brute_force_silhouette(mesh, points[i]);
        size += static_cast<double>(truth.size());
        octree.extract(points[i], edges, counters);
        std::sort(edges.begin(), edges.end());
        if (edges != truth) result.difference = "octree, viewpoint " + std::to_string(i);
        packed.face_bits(points[i], words);
        packed.silhouette(words, edges);
        if (edges != truth) result.difference = "packed, viewpoint " + std::to_string(i);
        if (!result.difference.empty()) return result;
    }
    result.mean_size = size / static_cast<double>(points.size());

    const TraversalCounters every{0, mesh.face_count(), mesh.edge_count()};
    const auto nothing = [](const HomogeneousPoint&) {};
    const std::vector<Method> methods{
        {"octree", nothing,
         [&](const HomogeneousPoint& point) {
             counters = {};
             octree.extract(point, edges, counters);
         },
         [&] { return counters; }},
        {"packed", nothing,
         [&](const HomogeneousPoint& point) {
             packed.face_bits(point, words);
             packed.silhouette(words, edges);
         },
         [&] { return every; }},
        {"scalar", nothing,
         [&](const HomogeneousPoint& point) { edges = brute_force_silhouette(mesh, point); },
         [&] { return every; }}};
    time_methods(result, methods, points, options.rounds, context);
    return result;
}

CaseResult bench_updates(const std::string& model, const HoughOctree& octree,
                         const HoughBenchOptions& options, const Context& context) {
    const Mesh& mesh = octree.mesh();
    const PackedBruteForce packed(mesh);
    const glm::vec3 up = mesh.up() == UpAxis::z ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const std::vector<HomogeneousPoint> points = orbit_path(mesh, up, 2.0, 0.5, options.frames);
    CaseResult result{"update", model, mesh.face_count(), mesh.edge_count()};

    SilhouetteTracker tracker(octree, points.front());
    FrameCheck check(tracker);
    std::vector<EdgeId> edges;
    std::vector<std::uint32_t> words;
    double size = 0.0;
    double flips = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        context.checkpoint();
        const ChangeSet& change = tracker.move_to(points[i]);
        size += change.silhouette_size;
        flips += static_cast<double>(change.flipped.size());
        packed.face_bits(points[i], words);
        if (const std::optional<std::string> difference = check.difference(change))
            result.difference = "tracker, frame " + std::to_string(i) + ": " + *difference;
        else if (!std::ranges::equal(words, tracker.face_words()))
            result.difference = "packed, frame " + std::to_string(i);
        if (!result.difference.empty()) return result;
    }
    result.mean_size = size / static_cast<double>(points.size());
    result.mean_flips = flips / static_cast<double>(points.size());

    const TraversalCounters every{0, mesh.face_count(), mesh.edge_count()};
    const TraversalCounters every_face{0, mesh.face_count(), 0};
    const auto nothing = [](const HomogeneousPoint&) {};
    TraversalCounters counters;
    const std::vector<Method> methods{
        {"tracker", [&](const HomogeneousPoint& point) { tracker.move_to(point); },
         [&](const HomogeneousPoint& point) { counters = tracker.move_to(point).counters; },
         [&] { return counters; }},
        {"packed", nothing,
         [&](const HomogeneousPoint& point) {
             packed.face_bits(point, words);
             packed.silhouette(words, edges);
         },
         [&] { return every; }},
        // The least that any update from face bits has to do, without a change set or silhouette.
        {"packed, bits only", nothing,
         [&](const HomogeneousPoint& point) { packed.face_bits(point, words); },
         [&] { return every_face; }},
        {"scalar", nothing,
         [&](const HomogeneousPoint& point) { edges = brute_force_silhouette(mesh, point); },
         [&] { return every; }}};
    time_methods(result, methods, points, options.rounds, context);
    return result;
}

}  // namespace

std::vector<CaseResult> bench_hough(const std::string& model, const Mesh& mesh,
                                    const HoughBenchOptions& options, const Context& context) {
    const Clock::time_point start = Clock::now();
    const HoughOctree octree(mesh);
    const std::chrono::duration<double, std::milli> build = Clock::now() - start;
    std::vector<CaseResult> results;
    results.push_back(bench_extraction(model, octree, options, context));
    results.push_back(bench_updates(model, octree, options, context));
    for (CaseResult& result : results) result.build_ms = build.count();
    return results;
}

}  // namespace rimline::tools
