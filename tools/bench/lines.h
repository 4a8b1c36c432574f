#pragma once

// `rimline bench lines`: line drawings with exact visibility, against a ray for each piece of a line.
//
// Every view is drawn in full first and checked by the oracle (line_oracle.h); nothing is timed where it finds an
// error. Then the views are timed: chains, coincident lines and strokes included, the silhouette given. Smooth
// contours and the removal of stubble are timed apart, with the options of `draw`. The rays (piece_rays.h) decide the
// pieces of the same drawing, and no more: they find neither the pieces nor chains.
//
// Times are of one thread, the least of all rounds for each view. Rounds of drawings and rays alternate.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/other_lines.h"
#include "tools/bench/whole_drawing.h"
#include "tools/command.h"
#include "tools/options/drawn_lines.h"

namespace rimline::tools {

struct LinesBenchOptions {
    std::uint32_t views = 21;
    std::uint32_t rounds = 5;
    DrawnLines lines{.kinds = {true, true, false, false}};  ///< Silhouettes and borders.
    /// For meshes that are known to be solids.
    LineSurface::Contacts contacts = LineSurface::Contacts::found;
    bool measures_threads = true;
    bool measures_whole = true;
    bool measures_others = true;  ///< Other programs, where they are installed.
};

/// Milliseconds of each view.
struct ViewTimes {
    std::vector<double> ms;
    double median_ms() const;
    double worst_ms() const;
};

struct RayResult {
    std::string name;
    ViewTimes times;
    double wrong_share = 0.0;  ///< Of the length of all pieces, where the drawing differs.
};

/// Another program, at the first view.
struct OtherResult {
    std::string method;
    std::string skipped;  ///< The reason why there are no figures; else empty.
    double ms = 0.0;
    double ratio = 0.0;                 ///< Over the drawing of the same view.
    std::optional<OtherErrors> errors;  ///< Not set for a program that gives only its time.
};

/// On all threads of oneTBB, by the clock.
struct ThreadsResult {
    std::uint32_t threads = 0;
    double drawing_ms = 0.0;  ///< Of one drawing at a time: median over the views.
    double parallel_ms =
        0.0;  ///< Of drawings on all threads, a drawer each: all views over their number.
};

struct LinesResult {
    std::string model;
    std::uint32_t faces = 0;
    double surface_ms = 0.0;          ///< Of LineSurface, on all threads, by the clock.
    std::uint64_t surface_bytes = 0;  ///< Of the heap.
    std::uint32_t views = 0;

    LineCheck check;           ///< Of all views.
    std::string difference{};  ///< The first from the oracle; nothing is timed then.
    LineReport work;           ///< Of all views.
    std::uint64_t chains = 0, strokes = 0, pieces = 0;

    ViewTimes extraction;  ///< Of the silhouette, by brute force. Not a part of the drawing.
    ViewTimes drawing;
    ViewTimes shaped;             ///< With smooth contours and without stubble.
    std::vector<RayResult> rays;  ///< By RayWay; empty where missing.
    std::vector<OtherResult> others;
    std::optional<ThreadsResult> threads;
    std::optional<WholeResult> whole;

    double a_view(std::uint64_t count) const { return static_cast<double>(count) / views; }
    double bytes_a_face() const { return static_cast<double>(surface_bytes) / faces; }
    /// Of the samples that the oracle decides, those where the drawing's visibility is wrong.
    double wrong_share() const;
    /// The rays' median time over that of the drawing. There must be rays.
    double ratio_to_rays() const;
};

/// The mesh must have an extent. Throws Error{cancelled}.
LinesResult bench_lines(const std::string& model, const Mesh& mesh,
                        const LinesBenchOptions& options, const Context& context);

/// "samples" and so on, summed; the first difference that is not empty.
void add_check(LineCheck& all, const LineCheck& one);
void add_work(LineReport& all, const LineReport& one);

}  // namespace rimline::tools
