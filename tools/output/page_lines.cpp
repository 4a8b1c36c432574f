#include "tools/output/page_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <span>

#include "silhouette/lines/line_simplify.h"
#include "tools/output/page_doubles.h"
#include "tools/output/page_stubble.h"

namespace rimline::tools {

namespace {

constexpr double k_meeting_mm = 0.05;

// The part of the segment in the rectangle, as shares of it (Liang, Barsky, 1984). Empty if first >= last.
struct SegmentPart {
    double first = 0.0, last = 1.0;
};

SegmentPart cut_segment(const PictureRectangle& frame, const glm::dvec2& a, const glm::dvec2& b) {
    SegmentPart part;
    const auto cut = [&](double from_border, double way) {  // Inside: from_border + t * way >= 0.
        if (way == 0.0) {
            if (from_border < 0.0) part.last = -1.0;
        } else if (way > 0.0) {
            part.first = std::max(part.first, -from_border / way);
        } else {
            part.last = std::min(part.last, -from_border / way);
        }
    };
    for (int axis = 0; axis < 2; ++axis) {
        const double way = b[axis] - a[axis];
        cut(a[axis] - frame.low[axis], way);
        cut(frame.high[axis] - a[axis], -way);
    }
    return part;
}

class PageLineMaker {
public:
    PageLineMaker(const LineDrawing& drawing, const ViewPlace& place,
                  const PageLineOptions& options, std::vector<PageLine>& lines)
        : drawing_(drawing), place_(place), options_(options), lines_(lines) {}

    void add_strokes() {
        for (const LineStroke& stroke : drawing_.strokes) {
            begin(false);
            for (const StrokePart& part : drawing_.parts_of(stroke)) add_run(part);
            end(stroke.is_closed);
        }
    }

    void add_hidden_lines() {
        for (std::uint32_t c = 0; c < drawing_.chains.size(); ++c) {
            const LineChain& chain = drawing_.chains[c];
            // A closed chain begins where one of its lines does, unless all of it is one line.
            std::uint32_t start = chain.first_run;
            if (chain.is_closed)
                while (start < chain.last_run &&
                       goes_on(start == chain.first_run ? chain.last_run - 1 : start - 1, start))
                    ++start;
            const bool is_loop = start == chain.last_run;
            if (is_loop) start = chain.first_run;
            const std::uint32_t count = chain.last_run - chain.first_run;
            begin(true);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t run = chain.first_run + (start - chain.first_run + i) % count;
                const std::uint32_t before = run == chain.first_run ? chain.last_run - 1 : run - 1;
                if (i > 0 && !goes_on(before, run)) {
                    end(false);
                    begin(true);
                }
                if (is_drawn_hidden(run)) add_run(drawing_.whole(run, false));
            }
            end(is_loop);
        }
    }

private:
    // Points of the drawing, [first, last).
    struct InkPart {
        std::uint32_t first, last;
        std::uint8_t ink;
    };

    bool is_drawn_hidden(std::uint32_t run) const {
        const std::uint32_t count = drawing_.runs[run].hidden_by;
        return count > 0 && count <= options_.hidden_by;
    }
    bool goes_on(std::uint32_t before, std::uint32_t run) const {
        return is_drawn_hidden(before) && is_drawn_hidden(run) &&
               place_.mm_per_unit *
                       glm::distance(drawing_.points_of(drawing_.runs[before]).back().position,
                                     drawing_.points_of(drawing_.runs[run]).front().position) <
                   1e-3;
    }

    void begin(bool is_hidden) {
        is_hidden_ = is_hidden;
        is_divided_ = false;
        begin_part();
    }

    void begin_part() {
        positions_.clear();
        chains_.clear();
        edges_.clear();
        lengths_.fill(0.0);
    }

    // The ink of the segment that ends at a point of the drawing.
    std::uint8_t ink_at(std::uint32_t point) const {
        if (options_.materials == nullptr) return k_no_material_ink;
        return options_.materials->ink_of(drawing_.sources[point].edge, options_.point);
    }

    void add_run(const StrokePart& run) {
        // Parts of one ink that follow each other share a point.
        std::vector<InkPart>& parts = ink_parts_;
        parts.clear();
        for (std::uint32_t i = run.first_point; i < run.last_point; ++i) {
            const std::uint8_t ink =
                ink_at(std::min(std::max(i, run.first_point + 1), run.last_point - 1));
            if (parts.empty())
                parts.push_back({i, i + 1, ink});
            else if (parts.back().ink == ink)
                parts.back().last = i + 1;
            else
                parts.push_back({i - 1, i + 1, ink});
        }
        if (run.is_reversed) std::reverse(parts.begin(), parts.end());
        for (const InkPart& part : parts) {
            if (!positions_.empty() && part.ink != ink_) divide();
            ink_ = part.ink;
            add_part(run, part);
        }
    }

    // The line goes on with another ink.
    void divide() {
        const glm::dvec2 place = positions_.back();
        if (!is_divided_) begin_ = positions_.front();
        is_divided_ = true;
        end_part(false);
        begin_part();
        positions_.push_back(place);
    }

    void add_part(const StrokePart& stroke_part, const InkPart& part) {
        const LineRun& run = drawing_.runs[stroke_part.run];
        const bool is_reversed = stroke_part.is_reversed;
        const std::span<const LinePoint> points(drawing_.points.data() + part.first,
                                                part.last - part.first);
        simplify(points, options_.simplify_mm / place_.mm_per_unit, kept_);
        if (is_reversed) std::reverse(kept_.begin(), kept_.end());
        for (const std::uint32_t i : kept_) positions_.push_back(points[i].position);
        const bool is_whole = part.first == run.first_point && part.last == run.last_point;
        lengths_[std::size_t(drawing_.chains[run.chain].kind)] +=
            is_whole ? run.length : points.back().arc - points.front().arc;
        if (chains_.empty() || chains_.back() != drawing_.chains[run.chain].id)
            chains_.push_back(drawing_.chains[run.chain].id);
        if (options_.mesh == nullptr) return;
        for (std::uint32_t i = part.first; i < part.last; ++i) {
            const std::uint32_t at = is_reversed ? part.last - 1 - (i - part.first) : i;
            // The first point of a later part has the edge of the part before.
            if (at == part.first && part.first != stroke_part.first_point) continue;
            const EdgeId edge = drawing_.sources[at].edge;
            if (edge != k_no_edge && (edges_.empty() || edges_.back() != edge))
                edges_.push_back(edge);
        }
    }

    // Adds the line that was begun, or the rest of it.
    void end(bool is_closed) {
        if (is_divided_ && is_closed && positions_.back() != begin_) positions_.push_back(begin_);
        end_part(is_closed && !is_divided_);
    }

    // Adds this part, or its parts in the frame.
    void end_part(bool is_closed) {
        if (positions_.empty()) return;
        if (!options_.frame) {
            for (const glm::dvec2& p : positions_) add_point(p);
            add_line(is_closed);
            return;
        }
        if (is_closed) positions_.push_back(positions_.front());
        bool is_cut = false;
        for (std::size_t i = 0; i + 1 < positions_.size(); ++i) {
            const glm::dvec2 a = positions_[i], b = positions_[i + 1];
            const SegmentPart part = cut_segment(*options_.frame, a, b);
            const bool is_outside = part.first >= part.last;
            if (is_outside || part.first > 0.0) add_line(false);
            is_cut = is_cut || is_outside || part.first > 0.0 || part.last < 1.0;
            if (is_outside) continue;
            if (points_.empty()) add_point(glm::mix(a, b, part.first));
            add_point(part.last < 1.0 ? glm::mix(a, b, part.last) : b);
            if (part.last < 1.0) add_line(false);
        }
        add_line(is_closed && !is_cut);
    }

    void add_point(const glm::dvec2& position) {
        const glm::dvec2 mm = rounded_to_um(place_.to_mm(position));
        if (points_.empty() || points_.back() != mm) points_.push_back(mm);
    }

    void add_line(bool is_closed) {
        if (is_closed && points_.size() > 1 && points_.front() == points_.back())
            points_.pop_back();
        const auto longest = std::max_element(lengths_.begin(), lengths_.end());
        PageLine line{.kind = static_cast<LineKind>(longest - lengths_.begin()),
                      .is_hidden = is_hidden_,
                      .is_closed = is_closed && points_.size() > 2,
                      .points = points_,
                      .curves = {},
                      .chains = chains_,
                      .edges = {},
                      .ink = ink_};
        points_.clear();
        const bool is_short =
            is_hidden_ && !is_divided_ && line.length_mm() < options_.min_length_mm;
        if (line.points.size() < 2 || is_short) return;
        for (const EdgeId edge : edges_) {
            const auto& [v, w] = options_.mesh->edge(edge).vertices;
            line.edges.push_back({options_.mesh->file_vertex(v), options_.mesh->file_vertex(w)});
        }
        lines_.push_back(std::move(line));
    }

    const LineDrawing& drawing_;
    const ViewPlace& place_;
    const PageLineOptions& options_;
    std::vector<PageLine>& lines_;

    bool is_hidden_ = false;   // The line that was begun.
    bool is_divided_ = false;  // A part of it, of another ink, was added.
    glm::dvec2 begin_{};       // Where it began, if it is divided.
    std::uint8_t ink_ = k_no_material_ink;
    std::vector<InkPart> ink_parts_;
    // Of this part of it, in picture coordinates.
    std::vector<glm::dvec2> positions_;
    std::vector<std::uint32_t> chains_;
    std::vector<EdgeId> edges_;
    std::array<double, k_line_kinds> lengths_{};
    std::vector<glm::dvec2> points_;  // In mm.
    std::vector<std::uint32_t> kept_;
};

// The curves of lines that leave frame or page nowhere by more than k_max_outside_mm: closer to the points where the
// tolerance lets them swing out.
class FittedCurves {
public:
    FittedCurves(const ViewPlace& place, const PageLineOptions& options)
        : tolerance_mm_(options.curve_mm) {
        if (options.frame) {
            const glm::dvec2 a = place.to_mm(options.frame->low);
            const glm::dvec2 b = place.to_mm(options.frame->high);
            low_ = glm::min(a, b);
            high_ = glm::max(a, b);
        } else if (options.page_mm) {
            low_ = glm::dvec2(0.0);
            high_ = *options.page_mm;
        }
    }

    std::vector<CurvePiece> of(const PageLine& line) const {
        double tolerance_mm = tolerance_mm_;
        std::vector<CurvePiece> curves = fit_curves(line.points, line.is_closed, tolerance_mm);
        while (tolerance_mm > k_max_outside_mm && !lie_inside(curves)) {
            tolerance_mm = std::max(0.5 * tolerance_mm, k_max_outside_mm);
            curves = fit_curves(line.points, line.is_closed, tolerance_mm);
        }
        return curves;
    }

private:
    // A curve lies within the hull of its ends, which are points of the line, and its control points.
    bool lie_inside(std::span<const CurvePiece> curves) const {
        return std::ranges::all_of(curves, [&](const CurvePiece& piece) {
            return piece.is_straight || (is_inside(piece.control_1) && is_inside(piece.control_2));
        });
    }
    bool is_inside(const glm::dvec2& mm) const {
        return glm::all(glm::greaterThanEqual(mm, low_ - k_max_outside_mm)) &&
               glm::all(glm::lessThanEqual(mm, high_ + k_max_outside_mm));
    }

    double tolerance_mm_;
    glm::dvec2 low_{-std::numeric_limits<double>::infinity()};
    glm::dvec2 high_{std::numeric_limits<double>::infinity()};
};

}  // namespace

PageLineOptions page_line_options(const DrawnLines& drawn, const ShownPart& part,
                                  const glm::dvec2& page_mm, double mm_per_unit) {
    const glm::dvec2 sides_mm = mm_per_unit * (part.high - part.low);
    PageLineOptions options{
        .min_length_mm = drawn.min_length_mm.value_or(DrawnLines::k_min_hidden_mm),
        .double_mm = drawn.double_mm(),
        .visible_double_mm = drawn.visible_double_mm(),
        .min_visible_mm = drawn.min_length_mm.value_or(0.0),
        .curve_mm = drawn.curve_mm,
        .hidden_stubble_mm =
            drawn.draws_hidden() ? drawn.stubble_mm_of(std::max(sides_mm.x, sides_mm.y)) : 0.0,
        .page_mm = page_mm,
        .frame = {}};
    if (drawn.hidden_by > 0) options.hidden_by = drawn.hidden_by;
    if (part.is_cut) options.frame = {part.low, part.high};
    return options;
}

void add_page_lines(const LineDrawing& drawing, const ViewPlace& place,
                    const PageLineOptions& options, std::vector<PageLine>& lines) {
    PageLineMaker maker(drawing, place, options, lines);
    const std::size_t first = lines.size();
    maker.add_strokes();
    maker.add_hidden_lines();
    if (options.visible_double_mm > 0.0)
        leave_out_visible_doubles(lines, first, options.visible_double_mm, options.min_visible_mm);
    if (options.double_mm > 0.0)
        leave_out_hidden_doubles(lines, first, options.double_mm, options.min_length_mm);
    // Ends that meet, meet exactly but for rounding, where no gap is joined.
    if (options.hidden_stubble_mm > 0.0)
        leave_out_hidden_stubble(lines, first, options.hidden_stubble_mm,
                                 std::max(3.0 * options.double_mm, k_meeting_mm));
    if (options.curve_mm > 0.0) {
        const FittedCurves curves(place, options);
        for (PageLine& line : std::span(lines).subspan(first)) line.curves = curves.of(line);
    }
}

}  // namespace rimline::tools
