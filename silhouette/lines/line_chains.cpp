#include "silhouette/lines/line_chains.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/lines/line_simplify.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_lines_a_checkpoint = 1u << 16;

}  // namespace

void LineChains::make(const LineFrame& frame, const CoveredStretches& covered,
                      const LineOptions& options, LineDrawing& drawing,
                      const std::stop_token& stop) {
    normals_.begin(frame);
    links_.find(frame, normals_, stop);
    const LongCall call{stop, {}};
    is_smooth_ = options.smooth > 0.0;
    if (is_smooth_) contour_.begin(frame, options.smooth, options.crease_angle_rad, normals_);
    last_node_ = k_no_vertex;
    is_done_.assign(frame.lines.size(), 0);
    chain_of_line_.assign(frame.lines.size(), k_no_chain);
    // Open chains from their ends, then closed ones.
    for (const bool is_closed : {false, true})
        for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
            if (i % k_lines_a_checkpoint == 0) call.checkpoint(0.0);
            for (std::uint32_t k = 0; k < 2; ++k)
                if (is_done_[i] == 0 && frame.lines[i].is_drawn &&
                    (is_closed || links_.next(2 * i + k) == k_no_end))
                    follow(frame, 2 * i + k, is_closed, covered, options, drawing);
        }
}

void LineChains::follow(const LineFrame& frame, LineEnd first_end, bool is_closed,
                        const CoveredStretches& covered, const LineOptions& options,
                        LineDrawing& drawing) {
    points_.clear();
    lines_.clear();
    // Whether the shape of a line matters, and of the one before. Where a closed chain begins, it always does.
    const auto is_shaped = [&](LineEnd end) {
        return is_smooth_ && (options.shapes_hidden || is_seen(frame, end / 2));
    };
    bool was_shaped = is_smooth_, is_now_shaped = is_shaped(first_end);
    for (LineEnd end = first_end;;) {
        is_done_[end / 2] = 1;
        lines_.push_back(end / 2);
        const LineEnd next = links_.next(end ^ 1u);
        const bool is_last = next == k_no_end || is_done_[next / 2] != 0;
        const bool is_next_shaped = is_last ? is_smooth_ : is_shaped(next);
        std::array<glm::dvec2, 2> shifts{glm::dvec2(0.0), glm::dvec2(0.0)};
        if (was_shaped || is_now_shaped) shifts[end % 2] = shift_at(frame, end);
        if (is_now_shaped || is_next_shaped) shifts[1 - end % 2] = shift_at(frame, end ^ 1u);
        add_line(frame, end, shifts, covered);
        if (is_last) break;
        end = next;
        was_shaped = is_now_shaped;
        is_now_shaped = is_next_shaped;
    }
    if (is_smooth_) move_to_contour(options.smooth, is_closed);
    split(is_closed, options);
    const auto chain = static_cast<std::uint32_t>(drawing.chains.size());
    add_chain(frame.lines[first_end / 2].kind, is_closed, options, drawing);
    if (drawing.chains.size() > chain)
        for (const std::uint32_t line : lines_) chain_of_line_[line] = chain;
}

// Adds the points of a line from one of its ends to the other.
void LineChains::add_line(const LineFrame& frame, LineEnd entered_at,
                          const std::array<glm::dvec2, 2>& shifts,
                          const CoveredStretches& covered) {
    const std::uint32_t line = entered_at / 2;
    const bool is_reversed = entered_at % 2 != 0;
    const FlatLine& flat = frame.flats[line];
    const bool is_orthographic = frame.view->is_orthographic();
    const std::array<glm::dvec3, 2> ends{frame.end_of(frame.lines[line], 0),
                                         frame.end_of(frame.lines[line], 1)};
    const EdgeId edge =
        frame.lines[line].is_intersection() ? k_no_edge : EdgeId{frame.lines[line].source};
    bool is_first = true;
    const auto add = [&](double share_in_picture, std::int32_t count, bool is_covered,
                         bool ends_line = false) {
        const double share = flat.share_in_space(share_in_picture, is_orthographic);
        ChainPoint& added = points_.emplace_back();
        const LinePoint* const last = points_.size() > 1 ? &(&added)[-1].point : nullptr;
        if (is_first && last != nullptr) {
            added.point = *last;  // The end of the line before.
        } else {
            const auto [position, depth] = frame.view->project(glm::mix(ends[0], ends[1], share));
            added.point = {
                position, depth,
                last != nullptr ? last->arc + glm::length(position - last->position) : 0.0};
        }
        is_first = false;
        added.source = {edge, static_cast<float>(share)};
        added.count = count;
        added.is_covered = is_covered;
        added.ends_line = ends_line;
        added.shift = glm::mix(shifts[0], shifts[1], share_in_picture);
    };
    const std::span<const LineEvent> events = frame.events_of(line);
    const std::span<const CoveredStretch> stretches = covered.of(line);
    if (!is_reversed) {
        std::int32_t count = frame.first_counts[line];
        std::size_t stretch = 0;
        double begin = 0.0;
        // A point at every event and at every end of a covered stretch.
        for (std::size_t k = 0; k <= events.size(); ++k) {
            const double end = k < events.size() ? events[k].share : 1.0;
            while (begin < end) {
                while (stretch < stretches.size() && stretches[stretch].end <= begin) ++stretch;
                const bool is_covered =
                    stretch < stretches.size() && stretches[stretch].begin <= begin;
                const double limit = stretch == stretches.size() ? end
                                     : is_covered                ? stretches[stretch].end
                                                                 : stretches[stretch].begin;
                add(begin, count, is_covered);
                begin = std::min(end, limit);
            }
            if (k < events.size()) count += events[k].jump;
        }
        add(1.0, count, false, true);
        return;
    }
    std::int32_t count = frame.first_counts[line];
    for (const LineEvent& event : events) count += event.jump;
    std::size_t stretch = stretches.size();
    double begin = 1.0;
    for (std::size_t k = events.size() + 1; k-- > 0;) {
        const double end = k > 0 ? events[k - 1].share : 0.0;
        while (begin > end) {
            while (stretch > 0 && stretches[stretch - 1].begin >= begin) --stretch;
            const bool is_covered = stretch > 0 && stretches[stretch - 1].end >= begin;
            const double limit = stretch == 0 ? end
                                 : is_covered ? stretches[stretch - 1].begin
                                              : stretches[stretch - 1].end;
            add(begin, count, is_covered);
            begin = std::max(end, limit);
        }
        if (k > 0) count -= events[k - 1].jump;
    }
    add(0.0, count, false, true);
}

// Whether a piece of the line is visible.
bool LineChains::is_seen(const LineFrame& frame, std::uint32_t line) {
    std::int32_t count = frame.first_counts[line], least = count;
    for (const LineEvent& event : frame.events_of(line))
        least = std::min(least, count += event.jump);
    return least <= 0;
}

// Only silhouettes move, and not where other lines begin.
glm::dvec2 LineChains::shift_at(const LineFrame& frame, LineEnd end) {
    const ViewLine& line = frame.lines[end / 2];
    if (line.kind != LineKind::silhouette || line.is_cut[0] || line.is_cut[1])
        return glm::dvec2(0.0);
    const std::uint32_t node = frame.nodes[end / 2][end % 2];
    if (node == last_node_) return last_shift_;
    const auto is_drawn = [&](LineEnd e) { return frame.lines[e / 2].is_drawn; };
    last_node_ = node;
    last_shift_ = std::ranges::count_if(frame.ends_at(node), is_drawn) == 2
                      ? contour_.shift_of(line.vertices[end % 2])
                      : glm::dvec2(0.0);
    return last_shift_;
}

// Points where visibility changes stay, because there the line meets the one that hides it. Towards them the
// shifts fall to zero over a few times the tolerance.
void LineChains::move_to_contour(double tolerance, bool is_closed) {
    const double ramp = 4.0 * tolerance;
    const std::size_t count = points_.size();
    shares_of_shift_.assign(count, 1.0);
    const auto is_fixed = [&](std::size_t i) {
        if (i == 0 || i + 1 >= count)
            return !is_closed || (points_.front().count > 0) != (points_[count - 2].count > 0);
        return (points_[i - 1].count > 0) != (points_[i].count > 0);
    };
    const auto pass = [&](auto place_of) {
        double distance = ramp;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = place_of(k);
            if (k > 0)
                distance += std::abs(points_[i].point.arc - points_[place_of(k - 1)].point.arc);
            if (is_fixed(i)) distance = 0.0;
            const double share = std::min(distance / ramp, 1.0);
            shares_of_shift_[i] =
                std::min(shares_of_shift_[i], share * share * (3.0 - 2.0 * share));
        }
    };
    if (count < 2) return;
    pass([](std::size_t k) { return k; });
    pass([&](std::size_t k) { return count - 1 - k; });
    for (std::size_t i = 0; i < count; ++i) {
        LinePoint& point = points_[i].point;
        point.position += shares_of_shift_[i] * points_[i].shift;
        point.arc = i == 0 ? 0.0
                           : points_[i - 1].point.arc +
                                 glm::length(point.position - points_[i - 1].point.position);
    }
}

// Sets pieces_: stretches of points_ of one visibility, or of one count.
void LineChains::split(bool is_closed, const LineOptions& options) {
    if (is_closed) rotate_to_change(options);
    pieces_.clear();
    for (std::uint32_t i = 0; i + 1 < points_.size(); ++i) {
        const ChainPoint& from = points_[i];
        if (from.ends_line && !pieces_.empty()) {
            pieces_.back().last = i + 1;
            continue;
        }
        const double length = points_[i + 1].point.arc - from.point.arc;
        const bool goes_on =
            !pieces_.empty() && pieces_.back().is_covered == from.is_covered &&
            (options.splits_counts ? pieces_.back().count == from.count
                                   : (pieces_.back().count > 0) == (from.count > 0));
        if (goes_on) {
            pieces_.back().last = i + 1;
            pieces_.back().length += length;
            pieces_.back().count = std::min(pieces_.back().count, from.count);
        } else {
            pieces_.push_back({i, i + 1, from.count, from.is_covered, length});
        }
    }
    if (options.gap > 0.0) bridge(is_closed, options.gap);
}

// A closed chain begins where visibility changes; else where a piece begins, if it has more than one.
void LineChains::rotate_to_change(const LineOptions& options) {
    if (points_.size() < 2 || rotate_to_change_of(false) || !options.splits_counts) return;
    rotate_to_change_of(true);
}

bool LineChains::rotate_to_change_of(bool counts) {
    const auto state = [&](const ChainPoint& p) {
        return std::pair(counts ? p.count : std::int32_t(p.count > 0), p.is_covered);
    };
    // points_.back() is the end of the last line, at the place of the first point: it begins nothing.
    const std::size_t count = points_.size() - 1;
    std::size_t start = 0;
    auto last = state(points_[count - 1]);
    for (std::size_t i = 0; i < count; ++i) {
        if (points_[i].ends_line) continue;
        if (state(points_[i]) != last && i > 0) {
            start = i;
            break;
        }
        last = state(points_[i]);
    }
    if (start == 0) return false;
    const double total = points_.back().point.arc, first_arc = points_[start].point.arc;
    rotated_.clear();
    for (std::size_t i = start; i < points_.size(); ++i) rotated_.push_back(points_[i]);
    for (std::size_t i = 0; i <= start; ++i) {
        rotated_.push_back(points_[i]);
        rotated_.back().point.arc += total;
    }
    for (ChainPoint& p : rotated_) p.point.arc -= first_arc;
    points_.swap(rotated_);
    return true;
}

// Only hidden pieces change. Short visible pieces between hidden ones may be the outline, where the chain goes to and
// fro: each stretch of it is seen from one of them.
void LineChains::bridge(bool is_closed, double gap) {
    const auto is_hidden = [](const Piece& piece) { return !piece.is_covered && piece.count > 0; };
    const auto is_seen = [](const Piece& piece) { return !piece.is_covered && piece.count == 0; };
    const std::size_t count = pieces_.size();
    for (std::size_t begin = 0, end = 0; begin < count; begin = std::max(end, begin + 1)) {
        // Of several counts, if these are split.
        double length = 0.0;
        for (end = begin; end < count && is_hidden(pieces_[end]); ++end)
            length += pieces_[end].length;
        const bool has_before = begin > 0 || is_closed, has_after = end < count || is_closed;
        if (end == begin || end - begin == count || length > gap || !has_before || !has_after)
            continue;
        if (!is_seen(pieces_[begin > 0 ? begin - 1 : count - 1]) ||
            !is_seen(pieces_[end < count ? end : 0]))
            continue;
        for (std::size_t i = begin; i < end; ++i) pieces_[i].count = 0;
    }
    std::size_t kept = 0;
    for (std::size_t i = 1; i < pieces_.size(); ++i) {
        Piece& last = pieces_[kept];
        const Piece& piece = pieces_[i];
        if (last.is_covered == piece.is_covered && last.count == piece.count) {
            last.last = piece.last;
            last.length += piece.length;
        } else {
            pieces_[++kept] = piece;
        }
    }
    if (!pieces_.empty()) pieces_.resize(kept + 1);
}

void LineChains::add_chain(LineKind kind, bool is_closed, const LineOptions& options,
                           LineDrawing& drawing) {
    const auto chain = static_cast<std::uint32_t>(drawing.chains.size());
    const auto first_run = static_cast<std::uint32_t>(drawing.runs.size());
    const double length = points_.empty() ? 0.0 : points_.back().point.arc;
    for (const Piece& piece : pieces_) {
        if (piece.is_covered) continue;
        piece_points_.clear();
        piece_sources_.clear();
        for (std::uint32_t i = piece.first; i <= piece.last; ++i) {
            // The same place once, but with the source of what follows.
            if (!piece_points_.empty() && i < piece.last &&
                points_[i].point.arc == piece_points_.back().arc && piece_points_.size() > 1) {
                if (!options.splits_counts) continue;
            }
            piece_points_.push_back(points_[i].point);
            piece_sources_.push_back(points_[i].source);
        }
        const auto first_point = static_cast<std::uint32_t>(drawing.points.size());
        if (options.simplify > 0.0) {
            simplify(piece_points_, options.simplify, kept_);
        } else {
            kept_.resize(piece_points_.size());
            for (std::uint32_t i = 0; i < kept_.size(); ++i) kept_[i] = i;
        }
        for (const std::uint32_t i : kept_) {
            drawing.points.push_back(piece_points_[i]);
            drawing.sources.push_back(piece_sources_[i]);
        }
        drawing.runs.push_back({.chain = chain,
                                .first_point = first_point,
                                .last_point = static_cast<std::uint32_t>(drawing.points.size()),
                                .hidden_by = static_cast<std::uint32_t>(std::max(piece.count, 0)),
                                .length = piece.length});
    }
    const auto last_run = static_cast<std::uint32_t>(drawing.runs.size());
    if (first_run == last_run) return;
    const bool is_whole = last_run - first_run == 1 && pieces_.size() == 1;
    drawing.chains.push_back({.first_run = first_run,
                              .last_run = last_run,
                              .id = chain,
                              .kind = kind,
                              .is_closed = is_closed && (is_whole || pieces_.size() > 1),
                              .length = length});
}

}  // namespace rimline
