#include "tools/bench/lines.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <limits>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "tools/bench/line_pieces.h"
#include "tools/bench/line_views.h"
#include "tools/bench/machine.h"
#include "tools/bench/piece_rays.h"
#include "tools/bench/whole_drawing.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<const char*, 3> k_ray_names{
    "own faces left out", "own faces left out, shortened by 0.001", "one-ring left out"};

// Other programs compute with floats.
constexpr double k_other_reach = 1e-4;

double clock_ms(const std::function<void()>& step) {
    const Clock::time_point start = Clock::now();
    step();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void keep_least(ViewTimes& times, std::size_t view, double ms) {
    times.ms.resize(std::max(times.ms.size(), view + 1), std::numeric_limits<double>::infinity());
    times.ms[view] = std::min(times.ms[view], ms);
}

class LinesBench {
public:
    LinesBench(LinesResult& result, const LineSurface& surface, const LinesBenchOptions& options,
               const Context& context)
        : result_(result),
          surface_(surface),
          mesh_(surface.mesh()),
          options_(options),
          context_(context),
          views_(bench_views(mesh_, options.views)),
          drawer_(surface) {}

    // Finds the silhouettes and pieces of all views too.
    void check() {
        for (const BenchView& view : views_) {
            Progress progress(context_, "checking lines of " + result_.model);
            silhouettes_.push_back(brute_force_silhouette(mesh_, view.view.point()));
            const LineDrawing& drawing = drawer_.draw(
                view.view, silhouettes_.back(), checkable(line_options(view)), progress.call());
            add_work(result_.work, drawing.report);
            pieces_.push_back(pieces_of(mesh_, drawing));
            result_.pieces += pieces_.back().size();
            add_check(result_.check,
                      check_lines(mesh_, view.view, drawing, k_oracle_spacing_mm / view.mm_per_unit,
                                  progress.call()));
            context_.checkpoint();
        }
        result_.difference = result_.check.first_difference;
    }

    void time() {
        std::optional<PieceRays> rays;
        if (PieceRays::missing().empty()) rays.emplace(mesh_);
        if (rays)
            for (const char* name : k_ray_names) result_.rays.push_back({name, {}, 0.0});
        // Round 0 warms up.
        for (std::uint32_t round = 0; round <= options_.rounds; ++round) {
            Progress progress(context_, "measuring lines of " + result_.model);
            progress.call().checkpoint(static_cast<double>(round) / (options_.rounds + 1));
            time_drawings(round);
            if (rays) time_rays(*rays, round);
        }
    }

    void time_on_threads() {
        const auto threads = static_cast<std::uint32_t>(tbb::this_task_arena::max_concurrency());
        if (threads < 2) return;
        ThreadsResult result{.threads = threads};
        ViewTimes alone;
        tbb::enumerable_thread_specific<LineDrawer> drawers([&] { return LineDrawer(surface_); });
        double parallel_ms = std::numeric_limits<double>::infinity();
        for (std::uint32_t round = 0; round <= options_.rounds; ++round) {
            context_.checkpoint();
            for (std::size_t v = 0; v < views_.size(); ++v) {
                const double ms = clock_ms([&] { draw(drawer_, v); });
                if (round > 0) keep_least(alone, v, ms);
            }
            const double ms = clock_ms([&] {
                tbb::parallel_for(std::size_t{0}, views_.size(),
                                  [&](std::size_t v) { draw(drawers.local(), v); });
            });
            if (round > 0) parallel_ms = std::min(parallel_ms, ms);
        }
        result.drawing_ms = alone.median_ms();
        result.parallel_ms = parallel_ms / static_cast<double>(views_.size());
        result_.threads = result;
    }

    void compare_with_others() {
        for (const OtherLines& lines : other_lines(mesh_, views_.front().view, context_)) {
            OtherResult& result = result_.others.emplace_back();
            result.method = lines.method;
            result.skipped = lines.skipped;
            if (!lines.skipped.empty()) continue;
            result.ms = lines.ms;
            result.ratio = lines.ms / result_.drawing.ms.front();
            if (!lines.segments.empty())
                result.errors =
                    compare_lines(pieces_.front(), lines.segments, k_other_reach * mesh_.radius());
        }
    }

private:
    LineOptions line_options(const BenchView& view, bool has_shape = false) const {
        LineOptions options = options_.lines.line_options(view.mm_per_unit);
        if (!has_shape) options.smooth = options.stubble = 0.0;
        return options;
    }
    const LineDrawing& draw(LineDrawer& drawer, std::size_t view, bool has_shape = false) const {
        return drawer.draw(views_[view].view, silhouettes_[view],
                           line_options(views_[view], has_shape));
    }

    void time_drawings(std::uint32_t round) {
        tbb::task_arena one_thread(1);
        for (std::size_t v = 0; v < views_.size(); ++v) {
            context_.checkpoint();
            const double us =
                time_step_us([&] { brute_force_silhouette(mesh_, views_[v].view.point()); });
            const LineDrawing* drawing = nullptr;
            double drawing_us = 0.0, shaped_us = 0.0;
            one_thread.execute([&] {
                drawing_us = time_step_us([&] { draw(drawer_, v); });
                shaped_us = time_step_us([&] { drawing = &draw(drawer_, v, true); });
            });
            if (round == 0) {
                result_.chains += drawing->chains.size();
                result_.strokes += drawing->strokes.size();
                continue;
            }
            keep_least(result_.extraction, v, 1e-3 * us);
            keep_least(result_.drawing, v, 1e-3 * drawing_us);
            keep_least(result_.shaped, v, 1e-3 * shaped_us);
        }
    }

    void time_rays(const PieceRays& rays, std::uint32_t round) {
        double all = 0.0;
        std::array<double, k_ray_names.size()> wrong{};
        for (std::size_t way = 0; way < k_ray_names.size(); ++way)
            for (std::size_t v = 0; v < views_.size(); ++v) {
                context_.checkpoint();
                const double us = time_step_us([&] {
                    rays.find_hidden(views_[v].view, pieces_[v], static_cast<RayWay>(way),
                                     is_hidden_);
                });
                if (round > 0) {
                    keep_least(result_.rays[way].times, v, 1e-3 * us);
                    continue;
                }
                const DifferingLength length = differing_length(pieces_[v], is_hidden_);
                wrong[way] += length.differing;
                all += length.all / k_ray_names.size();
            }
        for (std::size_t way = 0; way < k_ray_names.size(); ++way)
            if (round == 0 && all > 0.0) result_.rays[way].wrong_share = wrong[way] / all;
    }

    LinesResult& result_;
    const LineSurface& surface_;
    const Mesh& mesh_;
    const LinesBenchOptions& options_;
    const Context& context_;
    const std::vector<BenchView> views_;
    LineDrawer drawer_;
    std::vector<std::vector<EdgeId>> silhouettes_;
    std::vector<std::vector<LinePiece>> pieces_;
    std::vector<std::uint8_t> is_hidden_;
};

}  // namespace

double ViewTimes::median_ms() const { return quantile(ms, 0.5); }
double ViewTimes::worst_ms() const { return quantile(ms, 1.0); }

double LinesResult::wrong_share() const {
    const std::uint64_t decided = check.samples - check.undecided;
    return decided > 0 ? static_cast<double>(check.wrong_visibility) / static_cast<double>(decided)
                       : 0.0;
}

double LinesResult::ratio_to_rays() const {
    return rays.front().times.median_ms() / drawing.median_ms();
}

void add_check(LineCheck& all, const LineCheck& one) {
    all.samples += one.samples;
    all.undecided += one.undecided;
    all.wrong += one.wrong;
    all.wrong_visibility += one.wrong_visibility;
    all.missing_edges += one.missing_edges;
    if (all.first_difference.empty()) all.first_difference = one.first_difference;
}

void add_work(LineReport& all, const LineReport& one) {
    all.lines += one.lines;
    all.crossings += one.crossings;
    all.contacts += one.contacts;
    all.components += one.components;
    all.checks += one.checks;
    all.failed_checks += one.failed_checks;
    all.lines_by_rays += one.lines_by_rays;
    all.undecided_lines += one.undecided_lines;
}

LinesResult bench_lines(const std::string& model, const Mesh& mesh,
                        const LinesBenchOptions& options, const Context& context) {
    LinesResult result{.model = model, .faces = mesh.face_count(), .views = options.views};
    const std::uint64_t heap_bytes_before = heap_bytes();
    std::optional<LineSurface> surface;
    {
        Progress progress(context, "finding contacts of faces of " + model);
        result.surface_ms =
            clock_ms([&] { surface.emplace(mesh, options.contacts, progress.call()); });
    }
    result.surface_bytes = heap_bytes() - std::min(heap_bytes(), heap_bytes_before);
    LinesBench bench(result, *surface, options, context);
    bench.check();
    if (!result.difference.empty()) return result;
    bench.time();
    if (options.measures_others) bench.compare_with_others();
    if (options.measures_threads) bench.time_on_threads();
    if (options.measures_whole)
        result.whole = time_whole_drawing(model, mesh, options.rounds, context);
    return result;
}

}  // namespace rimline::tools
