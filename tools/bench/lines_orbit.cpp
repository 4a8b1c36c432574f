#include "tools/bench/lines_orbit.h"

#include <tbb/task_arena.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <unordered_set>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/ground_axes.h"
#include "tools/bench/line_views.h"
#include "tools/options/track_path.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

// What a frame has to know of the frame before.
struct PastFrame {
    std::unordered_map<std::uint32_t, std::uint32_t> id_of_edge;
    std::unordered_set<std::uint32_t> ids;
};

struct OrbitLengths {
    double all = 0.0, stayed = 0.0, kept = 0.0, in_old_chains = 0.0;
};

// Adds the lengths of a frame, and returns what the next one has to know.
PastFrame add_frame(const LineDrawing& drawing, const PastFrame& past, OrbitLengths& lengths,
                    std::uint64_t& new_chains) {
    PastFrame now;
    for (const LineChain& chain : drawing.chains) {
        now.ids.insert(chain.id);
        new_chains += !past.ids.contains(chain.id);
    }
    for (const LineRun& run : drawing.runs) {
        const std::uint32_t id = drawing.chains[run.chain].id;
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
            const double length =
                glm::distance(drawing.points[i].position, drawing.points[i + 1].position);
            lengths.all += length;
            if (past.ids.contains(id)) lengths.in_old_chains += length;
            // The last point of an edge is the first of the next one, whose source it has.
            const EdgeId edge = drawing.sources[i].edge;
            if (edge == k_no_edge) continue;
            now.id_of_edge.insert({index(edge), id});
            const auto found = past.id_of_edge.find(index(edge));
            if (found == past.id_of_edge.end()) continue;
            lengths.stayed += length;
            if (found->second == id) lengths.kept += length;
        }
    }
    return now;
}

}  // namespace

LinesOrbitResult bench_lines_orbit(const std::string& model, const Mesh& mesh,
                                   const LinesOrbitOptions& options, const Context& context) {
    LinesOrbitResult result{.model = model, .faces = mesh.face_count(), .options = options};
    const std::vector<HomogeneousPoint> path =
        orbit_path(mesh, glm::vec3(direction_of(mesh.up())), k_eye_radii, options.step_degrees,
                   options.frames);
    const LineSurface surface(mesh);
    const HoughOctree octree(mesh);
    LineDrawer fresh(surface), next(surface);
    std::optional<SilhouetteTracker> tracker;
    PastFrame past;
    OrbitLengths lengths;
    std::uint64_t chains = 0, new_chains = 0;
    Progress progress(context, "drawing the orbit of " + model);
    tbb::task_arena one_thread(1);
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        progress.call().checkpoint(static_cast<double>(frame) / options.frames);
        const BenchView view = bench_view(mesh, glm::dvec3(path[frame].xyz()));
        // All points of the lines, so that each edge has one.
        LineOptions lines = options.lines.line_options(view.mm_per_unit);
        lines.simplify = 0.0;
        if (frame == 0) {
            tracker.emplace(octree, view.view.point());
            past = add_frame(next.draw(view.view, tracker->silhouette(), lines), {}, lengths,
                             new_chains);
            lengths = {};
            new_chains = 0;
            continue;
        }
        const ChangeSet& changes = tracker->move_to(view.view.point());
        const LineDrawing* drawing = nullptr;
        one_thread.execute([&] {
            const std::span<const EdgeId> silhouette = tracker->silhouette();
            result.fresh.ms.push_back(
                1e-3 * time_step_us([&] { fresh.draw(view.view, silhouette, lines); }));
            result.next.ms.push_back(1e-3 * time_step_us([&] {
                                         drawing =
                                             &next.draw_next(view.view, silhouette, changes, lines);
                                     }));
        });
        chains += drawing->chains.size();
        past = add_frame(*drawing, past, lengths, new_chains);
    }
    const double frames = options.frames - 1;
    result.stayed_share = lengths.stayed / lengths.all;
    result.kept_share = lengths.kept / lengths.stayed;
    result.in_old_chains_share = lengths.in_old_chains / lengths.all;
    result.chains_a_frame = static_cast<double>(chains) / frames;
    result.new_chains_a_frame = static_cast<double>(new_chains) / frames;
    return result;
}

void print_orbit(const LinesOrbitResult& result) {
    std::printf("%s: %u faces, an orbit of %u frames, %g degrees each\n", result.model.c_str(),
                result.faces, result.options.frames, result.options.step_degrees);
    std::printf("  edges that were lines before %.1f%% of the length; %.1f%% of it keeps its id\n",
                100.0 * result.stayed_share, 100.0 * result.kept_share);
    std::printf(
        "  in chains with an id of the frame before %.1f%% of the length; a frame has %.0f chains, "
        "%.1f of them new\n",
        100.0 * result.in_old_chains_share, result.chains_a_frame, result.new_chains_a_frame);
    std::printf("  fresh drawing %.2f ms, next one %.2f ms (medians), %.2fx\n",
                result.fresh.median_ms(), result.next.median_ms(),
                result.next.median_ms() / result.fresh.median_ms());
    std::fflush(stdout);
}

nlohmann::ordered_json to_json(const LinesOrbitResult& result) {
    return {{"model", result.model},
            {"faces", result.faces},
            {"frames", result.options.frames},
            {"step_degrees", result.options.step_degrees},
            {"stayed_share", result.stayed_share},
            {"kept_share", result.kept_share},
            {"in_old_chains_share", result.in_old_chains_share},
            {"chains_a_frame", result.chains_a_frame},
            {"new_chains_a_frame", result.new_chains_a_frame},
            {"fresh_ms", result.fresh.median_ms()},
            {"next_ms", result.next.median_ms()}};
}

}  // namespace rimline::tools
