// Errors made on purpose in the lines of a view: checks along cycles, or counts below zero, or the oracle notice each.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "silhouette/lines/curve_rule.h"
#include "silhouette/lines/invisibility.h"
#include "silhouette/lines/line_chains.h"
#include "silhouette/lines/line_collection.h"
#include "silhouette/lines/line_events.h"
#include "silhouette/lines/line_graph.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/lines/local_rule.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

// Some edges of a mesh that bend by 0.3 are creases. Most end where no other line is: no cycle covers these.
constexpr float k_crease_angle_rad = 0.3f;
std::vector<std::uint8_t> some_creases(const Mesh& mesh, tests::Random& random) {
    std::vector<std::uint8_t> is_shown(mesh.edge_count());
    for (std::uint8_t& shown : is_shown) shown = random.below(4) == 0 ? 1 : 0;
    return is_shown;
}

// The lines of one view, step by step as LineDrawer draws them. Without intersections: rays decide doubtful ones of
// them whatever the events say.
class StepwiseDrawing {
public:
    /// The surface and the flags of creases must outlive it and its copies.
    StepwiseDrawing(const LineSurface& surface, const LineView& view,
                    std::span<const std::uint8_t> shown_creases)
        : mesh_(surface.mesh()), view_(view) {
        frame_.surface = &surface.geometry();
        frame_.view = &view_;
        options_ = checkable({});
        options_.crease_angle_rad = k_crease_angle_rad;
        options_.shown_creases = shown_creases;
        options_.draws[std::size_t(LineKind::intersection)] = false;
        const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh_, view_.point());
        LineCollection().collect(silhouette, options_, frame_);
        LineGraph().link(frame_);
        find_locals(frame_, true, options_.crease_angle_rad);
        find_curve_locals(frame_);
        LineEvents().find(frame_, false);
    }
    StepwiseDrawing(const StepwiseDrawing& other)
        : mesh_(other.mesh_), view_(other.view_), options_(other.options_), frame_(other.frame_) {
        frame_.view = &view_;
    }
    StepwiseDrawing& operator=(const StepwiseDrawing&) = delete;

    LineFrame& frame() { return frame_; }
    const LineFrame& frame() const { return frame_; }

    /// The distance between samples of the oracle.
    double spacing() const {
        return (view_.is_orthographic() ? 2.0 * mesh_.radius() : 0.7) / 200.0;
    }
    /// Decides visibility by what the frame says now, and asks the oracle.
    LineCheck finish() {
        Invisibility().spread(frame_);
        LineDrawing drawing;
        LineChains().make(frame_, {}, options_, drawing);
        return check_lines(mesh_, view_, drawing, spacing());
    }

private:
    const Mesh& mesh_;
    LineView view_;
    LineOptions options_;
    LineFrame frame_;
};

double length_of_line(const LineFrame& frame, std::uint32_t line) {
    return glm::distance(frame.flats[line].ends[0], frame.flats[line].ends[1]);
}

// Whether the oracle has a sample on both sides of an event, before the events beside it.
bool is_sampled_around(const LineFrame& frame, std::uint32_t event, double spacing) {
    const std::uint32_t line = frame.events[event].line;
    if (!frame.lines[line].is_drawn) return false;
    const std::span<const LineEvent> events = frame.events_of(line);
    const std::size_t k = event - frame.event_begin[line];
    const double before = k > 0 ? events[k - 1].share : 0.0;
    const double after = k + 1 < events.size() ? events[k + 1].share : 1.0;
    return std::min(events[k].share - before, after - events[k].share) *
               length_of_line(frame, line) >
           1.5 * spacing;
}

// Whether something is drawn whose counts depend on the invisibility at this end: another line from the same node.
bool has_drawn_neighbor(const LineFrame& frame, LineEnd end, double spacing) {
    const auto is_neighbor = [&](LineEnd other) {
        return other != end && frame.lines[other / 2].is_drawn &&
               length_of_line(frame, other / 2) > spacing;
    };
    return std::ranges::any_of(frame.ends_at(frame.nodes[end / 2][end % 2]), is_neighbor);
}

void drop_event(LineFrame& frame, std::uint32_t event) {
    const std::uint32_t line = frame.events[event].line;
    frame.events.erase(frame.events.begin() + event);
    for (std::size_t i = line + 1; i < frame.event_begin.size(); ++i) --frame.event_begin[i];
}

// Who noticed an error first.
struct Notices {
    std::size_t errors = 0, by_checks = 0, by_counts_below_zero = 0, by_oracle = 0, unnoticed = 0;

    // `before`: without the error. Where rays decide all pieces of lines, errors of counts are repaired.
    void add(StepwiseDrawing drawing, const LineReport& before, bool is_repaired_by_rays) {
        const LineCheck check = drawing.finish();
        const LineReport& report = drawing.frame().report;
        ++errors;
        if (report.failed_checks > before.failed_checks) {
            ++by_checks;
            if (is_repaired_by_rays) CHECK_MESSAGE(check.wrong == 0, check.first_difference);
        } else if (report.lines_by_rays > before.lines_by_rays) {
            ++by_counts_below_zero;
        } else if (check.wrong > 0) {
            ++by_oracle;
        } else {
            ++unnoticed;
        }
        // Rays see nothing of an event that is not there.
        if (!is_repaired_by_rays) CHECK(check.wrong > 0);
    }
};

struct MutationNotices {
    Notices crossings, contacts, locals, jumps;
};

template <typename T>
std::vector<T> some_of(std::vector<T> all, std::size_t count, tests::Random& random) {
    random.shuffle(all);
    if (all.size() > count) all.resize(count);
    return all;
}

// Makes some errors of each kind, one at a time.
void mutate_view(const Mesh& mesh, const LineView& view, std::uint64_t seed,
                 MutationNotices& notices) {
    constexpr std::size_t k_errors = 8;
    CAPTURE(seed);
    tests::Random random(seed);
    const LineSurface surface(mesh), without_contacts(mesh, LineSurface::Contacts::none);
    const std::vector<std::uint8_t> shown_creases = some_creases(mesh, random);
    const StepwiseDrawing drawing(surface, view, shown_creases);
    const StepwiseDrawing of_crossings(without_contacts, view, shown_creases);
    const LineFrame& frame = drawing.frame();
    REQUIRE(frame.lines.size() == of_crossings.frame().lines.size());
    StepwiseDrawing right(drawing);
    const LineCheck check = right.finish();
    REQUIRE(check.wrong == 0);
    REQUIRE(check.samples > check.undecided);
    const LineReport before = right.frame().report;
    REQUIRE(before.failed_checks == 0);
    REQUIRE(before.checks > 0);

    std::vector<std::uint32_t> crossings, contacts;
    for (std::uint32_t e = 0; e < frame.events.size(); ++e) {
        if (!is_sampled_around(frame, e, drawing.spacing())) continue;
        const LineEvent& event = frame.events[e];
        const auto is_same = [&](const LineEvent& other) {
            return other.share == event.share && other.jump == event.jump;
        };
        const bool is_crossing =
            std::ranges::any_of(of_crossings.frame().events_of(event.line), is_same);
        (is_crossing ? crossings : contacts).push_back(e);
    }
    std::vector<LineEnd> ends;
    for (const LineEnd end : frame.ends)
        if (frame.lines[end / 2].is_drawn && length_of_line(frame, end / 2) > drawing.spacing() &&
            has_drawn_neighbor(frame, end, drawing.spacing()))
            ends.push_back(end);

    for (const std::uint32_t event : some_of(crossings, k_errors, random)) {
        StepwiseDrawing wrong(drawing);
        drop_event(wrong.frame(), event);
        notices.crossings.add(wrong, before, false);
    }
    for (const std::uint32_t event : some_of(contacts, k_errors, random)) {
        StepwiseDrawing wrong(drawing);
        drop_event(wrong.frame(), event);
        notices.contacts.add(wrong, before, false);
    }
    for (const LineEnd end : some_of(ends, k_errors, random)) {
        StepwiseDrawing wrong(drawing);
        wrong.frame().locals[end / 2][end % 2] += random.below(2) == 0 ? 1 : -1;
        notices.locals.add(wrong, before, true);
    }
    for (const std::uint32_t event : some_of(crossings, k_errors, random)) {
        StepwiseDrawing wrong(drawing);
        wrong.frame().events[event].jump *= -1;
        notices.jumps.add(wrong, before, true);
    }
}

// Of 161 errors, checks notice 107 first, counts below zero 7, and the oracle 47: most of these on creases that no
// cycle covers.
TEST_CASE("checks or the oracle notice each error in events and local counts" *
          doctest::test_suite("plain")) {
    MutationNotices notices;
    const std::array<MeshSource, 3> sources{
        tests::crossing_knots(2000), make_built_in_shape("scene", 2000), tests::broken_knot(5)};
    std::uint64_t seed = 1;
    for (const MeshSource& source : sources) {
        const Mesh mesh(source);
        mutate_view(mesh, tests::view_of(mesh, {1, 2, 3}, false), seed++, notices);
        mutate_view(mesh, tests::view_of(mesh, {-3, 1, 0.5}, true), seed++, notices);
    }
    for (const Notices& of_kind :
         {notices.crossings, notices.contacts, notices.locals, notices.jumps}) {
        CHECK(of_kind.unnoticed == 0);
        CHECK(of_kind.errors >= 15);
        CHECK(of_kind.by_checks >= of_kind.errors / 3);
        CHECK(of_kind.by_oracle > 0);
    }
}

}  // namespace
}  // namespace rimline
