#include "silhouette/lines/line_drawer.h"

#include <cmath>

#include "silhouette/lines/coincident_lines.h"
#include "silhouette/lines/curve_rule.h"
#include "silhouette/lines/invisibility.h"
#include "silhouette/lines/line_chains.h"
#include "silhouette/lines/line_collection.h"
#include "silhouette/lines/line_events.h"
#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/line_geometry.h"
#include "silhouette/lines/line_graph.h"
#include "silhouette/lines/line_identity.h"
#include "silhouette/lines/line_strokes.h"
#include "silhouette/lines/line_stubble.h"
#include "silhouette/lines/local_rule.h"

namespace rimline {

struct LineDrawer::State {
    LineFrame frame;
    LineCollection collection;
    LineGraph graph;
    LineEvents events;
    Invisibility invisibility;
    CoincidentLines coincident;
    CoveredStretches covered;
    LineChains chains;
    LineIdentity identity;
    LineStrokes strokes;
    LineStubble stubble;
    LineDrawing drawing;
};

LineDrawer::LineDrawer(const LineSurface& surface) : state_(std::make_unique<State>()) {
    state_->frame.surface = &surface.geometry();
}

LineDrawer::~LineDrawer() = default;
LineDrawer::LineDrawer(LineDrawer&&) noexcept = default;
LineDrawer& LineDrawer::operator=(LineDrawer&&) noexcept = default;

const LineDrawing& LineDrawer::draw(const LineView& view, std::span<const EdgeId> silhouette,
                                    const LineOptions& options, const LongCall& call) {
    return draw(view, silhouette, nullptr, options, call);
}

const LineDrawing& LineDrawer::draw_next(const LineView& view, std::span<const EdgeId> silhouette,
                                         const ChangeSet& changes, const LineOptions& options,
                                         const LongCall& call) {
    RIMLINE_CHECK(changes.point == view.point());
    RIMLINE_CHECK(changes.silhouette_size == silhouette.size());
    return draw(view, silhouette, &changes, options, call);
}

const LineDrawing& LineDrawer::draw(const LineView& view, std::span<const EdgeId> silhouette,
                                    const ChangeSet* changes, const LineOptions& options,
                                    const LongCall& call) {
    for (const double length : {options.gap, options.min_length, options.stubble, options.smooth,
                                options.simplify, double{options.crease_angle_rad}})
        RIMLINE_CHECK(length >= 0.0 && std::isfinite(length));
    LineFrame& frame = state_->frame;
    LineDrawing& drawing = state_->drawing;
    drawing.clear();
    frame.view = &view;
    frame.report = {};

    call.checkpoint(0.0);
    state_->collection.collect(silhouette, options, frame);
    call.checkpoint(0.05);
    state_->graph.link(frame);
    call.checkpoint(0.1);
    find_locals(frame, options.draws[std::size_t(LineKind::crease)], options.crease_angle_rad);
    call.checkpoint(0.2);
    find_curve_locals(frame, call.stop);
    call.checkpoint(0.3);
    state_->events.find(frame, !options.keeps_coincident, call.stop);
    call.checkpoint(0.6);
    state_->invisibility.spread(frame, call.stop);
    call.checkpoint(0.8);
    state_->covered.clear();
    if (!options.keeps_coincident) state_->coincident.find(frame, state_->covered, call.stop);
    call.checkpoint(0.85);
    state_->chains.make(frame, state_->covered, options, drawing, call.stop);
    state_->identity.assign(frame, state_->chains.chain_of_line(), changes, drawing);
    call.checkpoint(0.9);
    state_->strokes.join(view.is_orthographic(), options, drawing, call.stop);
    call.checkpoint(0.95);
    if (options.stubble > 0.0) state_->stubble.remove(frame, options, drawing);

    for (const ViewLine& line : frame.lines) {
        if (!line.is_drawn) continue;
        ++frame.report.lines;
        if (line.kind == LineKind::crease) ++frame.report.creases;
    }
    drawing.report = frame.report;
    call.checkpoint(1.0);
    return drawing;
}

}  // namespace rimline
