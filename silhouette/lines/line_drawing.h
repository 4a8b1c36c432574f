#pragma once

// A line drawing: what a pen would draw of a mesh, and what is hidden.
//
//   chains   lines of one kind that follow each other; each has runs
//   runs     stretches of a chain of equal visibility; each has points
//   strokes  visible runs that go on into each other, across the places where a chain ends behind another
//
// Points have picture coordinates (line_view.h).

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/ids.h"

namespace rimline {

enum class LineKind : std::uint8_t {
    silhouette,    ///< Between a front and a back.
    border,        ///< An edge of one face.
    crease,        ///< An edge that bends by at least an angle.
    intersection,  ///< Where two faces pass through each other.
};
constexpr std::uint32_t k_line_kinds = 4;

struct LinePoint {
    glm::dvec2 position;
    double depth;  ///< As LineView::Projected.
    double arc;    ///< Length of the chain up to the point.
};

/// Where a point lies on the mesh: on the edge, at this share from vertices[0] to vertices[1]. k_no_edge on an
/// intersection of faces.
struct LineSource {
    EdgeId edge;
    float share;
};

struct LineRun {
    std::uint32_t chain;
    std::uint32_t first_point,
        last_point;           ///< [first, last). Runs that follow each other share a point's place.
    std::uint32_t hidden_by;  ///< The least number of faces in front of it. 0: visible.
    double length;
    bool is_visible() const noexcept { return hidden_by == 0; }
};

struct LineChain {
    std::uint32_t first_run, last_run;  ///< [first, last).
    std::uint32_t id;  ///< No other chain has it. LineDrawer::draw_next() keeps it over frames.
    LineKind kind;
    bool is_closed;
    double length;
};

/// A visible run as a part of a stroke: the whole run, or what is left of it where the next part runs over its end.
struct StrokePart {
    std::uint32_t run;
    bool is_reversed;
    std::uint32_t first_point, last_point;  ///< [first, last), in the order of the run.
};

struct LineStroke {
    std::uint32_t first_part, last_part;  ///< [first, last).
    bool is_closed;
    double length;
};

/// What was done, and the checks of its result.
struct LineReport {
    std::uint32_t lines = 0;          ///< Edges drawn, and segments of intersections.
    std::uint32_t creases = 0;        ///< Of these, creases that are no silhouettes.
    std::uint64_t crossings = 0;      ///< Places where a line passes behind another.
    std::uint64_t contacts = 0;       ///< Places where lines meet faces that are not their own.
    std::uint32_t components = 0;     ///< Sets of connected lines. One ray decides each.
    std::uint64_t checks = 0;         ///< Cycles of lines, each of which checks all signs on it.
    std::uint64_t failed_checks = 0;  ///< Of these, those that found an error.
    /// Lines decided by a ray a piece: those of components that failed, and doubtful ones of intersections.
    std::uint32_t lines_by_rays = 0;
    std::uint32_t undecided_lines = 0;  ///< Of these, lines for which rays could not tell either.
};

struct LineDrawing {
    std::vector<LinePoint> points;  ///< Of all runs, then of the parts that are not whole runs.
    /// One for each point. Where a run was cut for a stroke, on the edge of the segment that was cut.
    std::vector<LineSource> sources;
    std::vector<LineRun> runs;
    std::vector<LineChain> chains;
    std::vector<StrokePart> stroke_parts;
    std::vector<LineStroke> strokes;
    LineReport report;

    std::span<const LinePoint> points_of(const LineRun& run) const noexcept {
        return {points.data() + run.first_point, points.data() + run.last_point};
    }
    std::span<const LinePoint> points_of(const StrokePart& part) const noexcept {
        return {points.data() + part.first_point, points.data() + part.last_point};
    }
    /// The part of a stroke that is a whole run.
    StrokePart whole(std::uint32_t run, bool is_reversed) const noexcept {
        return {run, is_reversed, runs[run].first_point, runs[run].last_point};
    }
    std::span<const LineRun> runs_of(const LineChain& chain) const noexcept {
        return {runs.data() + chain.first_run, runs.data() + chain.last_run};
    }
    std::span<const StrokePart> parts_of(const LineStroke& stroke) const noexcept {
        return {stroke_parts.data() + stroke.first_part, stroke_parts.data() + stroke.last_part};
    }
    void clear() noexcept {
        points.clear();
        sources.clear();
        runs.clear();
        chains.clear();
        stroke_parts.clear();
        strokes.clear();
        report = {};
    }
};

}  // namespace rimline
