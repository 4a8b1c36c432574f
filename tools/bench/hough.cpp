#include "tools/bench/hough.h"

#include <algorithm>
#include <chrono>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/brute_force_packed.h"
#include "silhouette/methods/brute_force_tracker.h"
#include "silhouette/methods/windowed_brute_force.h"
#include "tools/bench/fresh_tracker.h"
#include "tools/bench/viewpoints.h"
#include "tools/commands/frame_check.h"
#include "tools/options/track_path.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Points = std::span<const HomogeneousPoint>;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t k_worst_seed = 1;
constexpr std::uint32_t k_vtk_frames = 60;
constexpr std::uint32_t k_vtk_rounds = 3;
constexpr std::uint64_t k_vtk_faces = 20'000'000;  // For all frames together.

// Every n-th point is compared with the scalar oracle and timed with it. n is no multiple of three, because
// the points are at three radii in turn.
std::size_t scalar_stride(std::size_t points, std::uint32_t faces) {
    const std::uint64_t affordable =
        std::max<std::uint64_t>(k_scalar_faces / std::max(faces, 1u), 8);
    const std::size_t stride = (points + affordable - 1) / affordable;
    return stride > 1 && stride % 3 == 0 ? stride + 1 : std::max<std::size_t>(stride, 1);
}

std::vector<EdgeId> sorted(std::span<const EdgeId> edges) {
    std::vector<EdgeId> result(edges.begin(), edges.end());
    std::sort(result.begin(), result.end());
    return result;
}

class HoughBench {
public:
    HoughBench(ModelResult& result, const HoughOctree& octree, const HoughBenchOptions& options,
               const Context& context)
        : result_(result),
          octree_(octree),
          mesh_(octree.mesh()),
          reference_(mesh_),
          brute_force_(mesh_),
          options_(options),
          context_(context) {}

    void extraction() {
        const std::vector<HomogeneousPoint> points =
            spread_viewpoints(mesh_, point_count(options_.viewpoints, mesh_.face_count()));
        CaseResult& c = result_.extraction;
        check_extraction(c, points);
        if (!c.difference.empty()) return;

        const PlainLoop plain(mesh_);
        BlockScratch scratch = octree_.make_scratch();
        TraversalCounters work;
        std::uint32_t plain_sum = 0;
        const std::vector<Contender> contenders{
            {.name = "octree",
             .step =
                 [&](const HomogeneousPoint& point) {
                     work = {};
                     octree_.extract(point, edges_, work, scratch);
                 },
             .counters = [&] { return work; }},
            brute_in_full(),
            scalar(points.size()),
            {.name = "plain loop",
             .step =
                 [&](const HomogeneousPoint& point) {
                     plain_sum += plain.count_edges(plain.count_front(point));
                 },
             .counters = [&] { return everything(); },
             .is_part = true}};
        c.methods = time_in_turn(contenders, points, options_.rounds,
                                 "measuring extraction of " + result_.model, context_);
        result_.ceiling = brute_force_ceiling(mesh_.face_count(), c.methods[3].median_us(),
                                              c.methods[1].median_us());
    }

    void update() {
        const std::vector<HomogeneousPoint> points =
            half_degree_orbit(mesh_, point_count(options_.frames, mesh_.face_count()));
        const Points steps = Points(points).subspan(1);
        CaseResult& c = result_.update;
        SilhouetteTracker tracker(octree_, points.front());
        BruteForceTracker brute(mesh_, points.front());
        result_.tracker_bytes = tracker.size_bytes();
        result_.stream = check_updates(c, tracker, brute, "brute tracker", steps);
        if (!c.difference.empty()) return;

        TraversalCounters brute_work;
        const std::vector<Contender> contenders{
            moves_of(tracker, points.front()),
            {.name = "brute tracker",
             .step =
                 [&](const HomogeneousPoint& point) { brute_work = brute.move_to(point).counters; },
             .counters = [&] { return brute_work; },
             .prepare = [&] { brute.move_to(points.front()); }},
            brute_in_full(),
            {.name = "brute, bits only",
             .step = [&](const HomogeneousPoint& point) { brute_force_.look_from(point); },
             .counters = [&] { return every_face(); },
             .is_part = true},
            scalar(steps.size())};
        c.methods = time_in_turn(contenders, steps, options_.rounds,
                                 "measuring updates of " + result_.model, context_);
        if (options_.vtk) time_vtk_on(steps);
    }

    void worst() {
        const std::vector<HomogeneousPoint> points = random_path(
            mesh_, k_worst_seed, point_count(options_.worst_frames, mesh_.face_count()) + 1);
        const Points steps = Points(points).subspan(1);
        CaseResult& c = result_.worst;
        SilhouetteTracker tracker(octree_, points.front());
        FreshTracker fresh(octree_, points.front());
        check_updates(c, tracker, fresh, "fresh tracker", steps);
        if (!c.difference.empty()) return;

        TraversalCounters fresh_work;
        const std::vector<Contender> contenders{
            moves_of(tracker, points.front()),
            {.name = "fresh tracker",
             .step =
                 [&](const HomogeneousPoint& point) { fresh_work = fresh.move_to(point).counters; },
             .counters = [&] { return fresh_work; },
             .prepare = [&] { fresh.move_to(points.front()); }}};
        c.methods = time_in_turn(contenders, steps, options_.rounds,
                                 "measuring the worst updates of " + result_.model, context_);
        result_.worst_update = compare_worst(c.methods[0], c.methods[1]);
    }

private:
    TraversalCounters every_face() const { return {0, mesh_.face_count(), 0}; }
    TraversalCounters everything() const { return {0, mesh_.face_count(), mesh_.edge_count()}; }

    Contender brute_in_full() {
        return {.name = "brute force",
                .step =
                    [this](const HomogeneousPoint& point) {
                        brute_force_.look_from(point);
                        brute_force_.silhouette(edges_);
                    },
                .counters = [this] { return everything(); }};
    }
    Contender scalar(std::size_t points) {
        return {.name = "scalar",
                .step =
                    [this](const HomogeneousPoint& point) {
                        edges_ = brute_force_silhouette(mesh_, point);
                    },
                .counters = [this] { return everything(); },
                .every = scalar_stride(points, mesh_.face_count())};
    }
    Contender moves_of(SilhouetteTracker& tracker, const HomogeneousPoint& start) {
        return {.name = "tracker",
                .step =
                    [this, &tracker](const HomogeneousPoint& point) {
                        tracker_work_ = tracker.move_to(point).counters;
                    },
                .counters = [this] { return tracker_work_; },
                .prepare = [&tracker, start] { tracker.move_to(start); }};
    }

    void check_extraction(CaseResult& c, Points points) {
        Progress progress(context_, "checking extraction of " + result_.model);
        const LongCall call = progress.call();
        const std::size_t stride = scalar_stride(points.size(), mesh_.face_count());
        BlockScratch scratch = octree_.make_scratch();
        TraversalCounters work;
        std::vector<EdgeId> found, brute;
        for (std::size_t i = 0; i < points.size(); ++i) {
            call.checkpoint(static_cast<double>(i) / static_cast<double>(points.size()));
            reference_.face_bits(points[i], words_);
            reference_.silhouette(words_, edges_);
            brute_force_.look_from(points[i]);
            brute_force_.silhouette(brute);
            octree_.extract(points[i], found, work, scratch);
            const std::string place = ", viewpoint " + std::to_string(i);
            if (i % stride == 0 && edges_ != brute_force_silhouette(mesh_, points[i]))
                c.difference = "packed" + place;
            else if (sorted(brute) != edges_)
                c.difference = "brute force" + place;
            else if (sorted(found) != edges_)
                c.difference = "octree" + place;
            if (!c.difference.empty()) return;
            c.mean_size += static_cast<double>(edges_.size()) / static_cast<double>(points.size());
        }
        c.points = points.size();
    }

    // Moves both trackers along the steps. Returns the bytes of the changes.
    template <typename Baseline>
    StreamBytes check_updates(CaseResult& c, SilhouetteTracker& tracker, Baseline& baseline,
                              const std::string& baseline_name, Points steps) {
        Progress progress(context_, "checking the " + c.name + " case of " + result_.model);
        const LongCall call = progress.call();
        const std::size_t scalar_frames =
            steps.size() / scalar_stride(4 * steps.size(), mesh_.face_count());
        FrameCheck frame_check(tracker);
        sizes_.clear();
        StreamBytes bytes;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            call.checkpoint(static_cast<double>(i) / static_cast<double>(steps.size()));
            const std::string frame = ", frame " + std::to_string(i + 1);
            const ChangeSet& change = tracker.move_to(steps[i]);
            const ChangeSet& same = baseline.move_to(steps[i]);
            reference_.face_bits(steps[i], words_);
            reference_.silhouette(words_, edges_);
            if (i < scalar_frames)
                if (const auto difference = frame_check.difference(change))
                    c.difference = "tracker" + frame + ": " + *difference;
            if (!std::ranges::equal(words_, tracker.face_words()) ||
                sorted(tracker.silhouette()) != edges_)
                c.difference = "tracker" + frame;
            else if (!std::ranges::equal(words_, baseline.face_words()) ||
                     sorted(baseline.silhouette()) != edges_ ||
                     same.flipped.size() != change.flipped.size() ||
                     same.added.size() != change.added.size() ||
                     same.removed.size() != change.removed.size())
                c.difference = baseline_name + frame;
            if (!c.difference.empty()) return bytes;
            const double n = static_cast<double>(steps.size());
            c.mean_size += static_cast<double>(change.silhouette_size) / n;
            c.mean_flips += static_cast<double>(change.flipped.size()) / n;
            bytes += stream_bytes(change, words_.size());
            sizes_.push_back(change.silhouette_size);
        }
        c.points = steps.size();
        return bytes;
    }

    void time_vtk_on(Points steps) {
        const std::uint64_t affordable =
            std::max<std::uint64_t>(k_vtk_faces / mesh_.face_count(), 5);
        const std::size_t count =
            std::min<std::size_t>({steps.size(), k_vtk_frames, std::size_t{affordable}});
        result_.vtk = time_vtk(mesh_, steps.first(count), k_vtk_rounds, context_);
        for (const std::uint32_t size : std::span(sizes_).first(count))
            result_.vtk_mean_size += static_cast<double>(size) / static_cast<double>(count);
    }

    static WorstUpdate compare_worst(const Times& ours, const Times& fresh) {
        const auto sum = [](const TraversalCounters& work) {
            return static_cast<double>(work.box_checks + work.face_checks + work.edge_checks);
        };
        WorstUpdate worst;
        std::vector<double> ratios;
        for (std::size_t i = 0; i < ours.us.size(); ++i) {
            worst.work =
                std::max(worst.work, sum(ours.work[i]) / std::max(sum(fresh.work[i]), 1.0));
            ratios.push_back(ours.us[i] / fresh.us[i]);
        }
        worst.p999 = ours.quantile_us(0.999) / fresh.quantile_us(0.999);
        worst.frame_p999 = quantile(std::move(ratios), 0.999);
        return worst;
    }

    ModelResult& result_;
    const HoughOctree& octree_;
    const Mesh& mesh_;
    PackedBruteForce reference_;
    WindowedBruteForce brute_force_;
    const HoughBenchOptions& options_;
    const Context& context_;
    std::vector<EdgeId> edges_;
    std::vector<std::uint32_t> words_;
    std::vector<std::uint32_t> sizes_;  // Sizes of the silhouettes of the frames checked last.
    TraversalCounters tracker_work_;
};

double median_build_ms(const std::string& model, const Mesh& mesh, std::uint32_t builds,
                       const Context& context) {
    Progress progress(context, "building the octree of " + model);
    const LongCall call = progress.call();
    std::vector<double> times_ms;
    for (std::uint32_t i = 0; i < builds; ++i) {
        call.checkpoint(static_cast<double>(i) / builds);
        const Clock::time_point start = Clock::now();
        const HoughOctree octree(mesh, {}, LongCall{context.stop, {}});
        times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    return quantile(std::move(times_ms), 0.5);
}

}  // namespace

std::string ModelResult::difference() const {
    for (const CaseResult* c : {&extraction, &update, &worst})
        if (!c->difference.empty()) return c->name + ", " + model + ": " + c->difference;
    return {};
}

ModelResult bench_hough(const std::string& model, const Mesh& mesh,
                        const HoughBenchOptions& options, const Context& context) {
    ModelResult result;
    result.model = model;
    result.faces = mesh.face_count();
    result.edges = mesh.edge_count();
    result.build_ms = median_build_ms(model, mesh, options.builds, context);
    const HoughOctree octree(mesh);
    result.octree_bytes = octree.statistics().size_bytes;
    HoughBench bench(result, octree, options, context);
    bench.extraction();
    bench.update();
    if (options.worst_frames > 0) bench.worst();
    return result;
}

std::uint32_t point_count(std::uint32_t asked, std::uint32_t faces) {
    if (faces <= 1'000'000) return asked;
    const std::uint64_t fewer = std::uint64_t{asked} * 1'000'000 / faces;
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(asked, std::max<std::uint64_t>(fewer, k_min_points)));
}

double ratio(const Times& baseline, const Times& ours) {
    return baseline.median_us() / ours.median_us();
}

}  // namespace rimline::tools
