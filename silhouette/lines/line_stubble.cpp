#include "silhouette/lines/line_stubble.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "silhouette/lines/cut_part.h"
#include "silhouette/lines/face_count.h"
#include "silhouette/mesh/disjoint_sets.h"

namespace rimline {

namespace {

// Doubles are shorter than this many times LineOptions::stubble.
constexpr double k_double_lengths = 6.0;
// The distance of places at which a stroke is tested for the outline, in the same unit.
constexpr double k_outline_spacing = 0.25, k_max_outline_places = 24.0;
constexpr LineStubble::OutlineTest k_has_outline{.gap_share = 0.5, .least_share = 0.0};
constexpr LineStubble::OutlineTest k_is_outline{.gap_share = 0.125, .least_share = 0.5};
// Doubles run in about the same direction, and beside each other: within 45 degrees. In shares of the gap, at places of
// this spacing, unless they touch.
constexpr double k_min_square_cos = 0.5;
constexpr double k_double_spacing = 0.25, k_touching = 0.125;
// A tail is beside a longer stroke within this share of the gap: the ink of both joins.
constexpr double k_tail_reach = 0.35;
// Places of a tail are no nearer to each other than this share of the stubble, however small the gap is.
constexpr double k_least_spacing = 1.0 / 256.0;
// What closes is narrow where it is no longer than this many times its diameter: an ellipse, if a fifth as wide as long.
constexpr double k_narrow_diameters = 2.15;
constexpr std::uint32_t k_no_stroke = 0xffffffffu;

// The parts of a segment that are no longer than `spacing`; where that is next to nothing, many.
int parts_of(double length, double spacing) {
    return 1 + static_cast<int>(std::min(length / spacing, 1e6));
}

}  // namespace

LineStubble::Extent::Extent() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
}

void LineStubble::Extent::include(const glm::dvec2& place) {
    static const std::array<glm::dvec2, k_directions> k_ways = [] {
        std::array<glm::dvec2, k_directions> ways;
        for (std::size_t i = 0; i < k_directions; ++i) {
            const double angle = std::numbers::pi * double(i) / double(k_directions);
            ways[i] = {std::cos(angle), std::sin(angle)};
        }
        return ways;
    }();
    for (std::size_t i = 0; i < k_directions; ++i) {
        const double at = glm::dot(place, k_ways[i]);
        low[i] = std::min(low[i], at);
        high[i] = std::max(high[i], at);
    }
}

void LineStubble::Extent::include(const Extent& other) {
    for (std::size_t i = 0; i < k_directions; ++i) {
        low[i] = std::min(low[i], other.low[i]);
        high[i] = std::max(high[i], other.high[i]);
    }
}

double LineStubble::Extent::diameter() const {
    double diameter = 0.0;
    for (std::size_t i = 0; i < k_directions; ++i) diameter = std::max(diameter, high[i] - low[i]);
    return diameter;
}

// Of what closes: that of one line, where it looks like one.
double LineStubble::seen_length(double length, const Extent& extent) {
    return length <= k_narrow_diameters * extent.diameter() ? 0.5 * length : length;
}

void LineStubble::fill(double gap, const LineDrawing& drawing) {
    segments_.clear();
    first_segments_.assign(1, 0);
    lengths_.clear();
    extents_.assign(drawing.strokes.size(), {});
    is_closed_.clear();
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t s = 0; s < drawing.strokes.size(); ++s) {
        const LineStroke& stroke = drawing.strokes[s];
        std::optional<glm::dvec2> from;
        // A pen goes on from one part to the next.
        for (const StrokePart& part : drawing.parts_of(stroke)) {
            const std::uint32_t count = part.last_point - part.first_point;
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t point =
                    part.is_reversed ? part.last_point - 1 - i : part.first_point + i;
                const glm::dvec2& to = drawing.points[point].position;
                if (from && (*from != to || i > 0)) {
                    // A segment lies on the edge of the point that it leads to in the order of the run.
                    const EdgeId edge =
                        drawing.sources[part.is_reversed && i > 0 ? point + 1 : point].edge;
                    segments_.push_back({*from, to, s, edge});
                    low = glm::min(low, glm::min(*from, to));
                    high = glm::max(high, glm::max(*from, to));
                }
                from = to;
                extents_[s].include(to);
            }
        }
        first_segments_.push_back(static_cast<std::uint32_t>(segments_.size()));
        lengths_.push_back(stroke.length);
        is_closed_.push_back(stroke.is_closed ? 1 : 0);
    }
    const glm::dvec2 size = high - low;
    grid_.reset(low, high,
                std::max(2.0 * gap, (size.x + size.y) / (2.0 * double(segments_.size() + 1))), gap);
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
        grid_.add(i, segments_[i].from, segments_[i].to);
    grid_.finish();
}

glm::dvec2 LineStubble::nearest_on(const Segment& segment, const glm::dvec2& place) {
    const glm::dvec2 way = segment.to - segment.from;
    const double share = glm::dot(place - segment.from, way) / std::max(glm::dot(way, way), 1e-300);
    return glm::mix(segment.from, segment.to, std::clamp(share, 0.0, 1.0));
}

double LineStubble::distance_to(const Segment& segment, const glm::dvec2& place) {
    return glm::distance(place, nearest_on(segment, place));
}

template <typename IsAsked>
bool LineStubble::any_near(const glm::dvec2& place, IsAsked&& is_asked) const {
    bool found = false;
    grid_.each_cell(place, place, [&](std::uint32_t cell) {
        for (const std::uint32_t i : grid_.segments_in(cell))
            found = found || is_asked(segments_[i]);
    });
    return found;
}

bool LineStubble::is_held(const glm::dvec2& place, std::uint32_t stroke, double reach) const {
    return any_near(place, [&](const Segment& segment) {
        return segment.stroke != stroke && is_there_[segment.stroke] != 0 &&
               distance_to(segment, place) <= reach;
    });
}

glm::dvec2 LineStubble::way_at(std::uint32_t segment, double least) const {
    const Segment &own = segments_[segment], *from = &own, *to = &own;
    if (glm::distance(own.from, own.to) < least) {
        if (segment > first_segments_[own.stroke]) --from;
        if (segment + 1 < first_segments_[own.stroke + 1]) ++to;
    }
    return to->to - from->from;
}

bool LineStubble::has_other_along(std::uint32_t stroke, const glm::dvec2& way,
                                  const glm::dvec2& place, double reach) const {
    // 0 across the way, 1 along it. 0 where either has no length.
    const auto square_cos = [&](const glm::dvec2& other) {
        const double dot = glm::dot(way, other);
        return dot == 0.0 ? 0.0 : dot * dot / (glm::dot(way, way) * glm::dot(other, other));
    };
    const bool has_way = way != glm::dvec2(0.0);
    return any_near(place, [&](const Segment& segment) {
        if (segment.stroke == stroke || stays_[segment.stroke] == 0) return false;
        const glm::dvec2 aside = nearest_on(segment, place) - place;
        const double distance = glm::length(aside);
        if (distance > reach) return false;
        if (has_way && square_cos(segment.to - segment.from) < k_min_square_cos) return false;
        // Before and behind a stroke lies no double of it, but what goes on from there.
        return distance <= k_touching * reach || square_cos(aside) <= 1.0 - k_min_square_cos;
    });
}

bool LineStubble::is_loose(std::uint32_t stroke, const LineOptions& options) const {
    if (first_segments_[stroke] == first_segments_[stroke + 1]) return true;
    if (lengths_[stroke] >= 2.0 * options.stubble) return false;
    if (is_closed_[stroke] != 0)
        return seen_length(lengths_[stroke], extents_[stroke]) < options.stubble;
    const auto is_end_loose = [&](const glm::dvec2& end) {
        return !is_held(end, stroke, options.gap);
    };
    const int loose_ends = int(is_end_loose(segments_[first_segments_[stroke]].from)) +
                           int(is_end_loose(segments_[first_segments_[stroke + 1] - 1].to));
    return lengths_[stroke] < loose_ends * options.stubble;
}

bool LineStubble::is_at_outline(std::uint32_t stroke, const LineFrame& frame,
                                const LineOptions& options, const OutlineTest& test) const {
    // The line may lie beside that of the mesh.
    const double reach = options.smooth + test.gap_share * options.gap;
    const double places = std::min(
        std::ceil(lengths_[stroke] / (k_outline_spacing * options.stubble)), k_max_outline_places);
    const double spacing = lengths_[stroke] / places;
    const double needed = std::max(1.0, std::ceil(test.least_share * places));
    double next = 0.5 * spacing, arc = 0.0, found = 0.0, left = places;
    for (std::uint32_t i = first_segments_[stroke]; i < first_segments_[stroke + 1]; ++i) {
        const Segment& segment = segments_[i];
        const glm::dvec2 way = segment.to - segment.from;
        const double length = glm::length(way);
        for (; next < arc + length; next += spacing) {
            const glm::dvec2 place = segment.from + ((next - arc) / length) * way;
            const glm::dvec2 side = (reach / length) * glm::dvec2(-way.y, way.x);
            if (!is_covered(*frame.surface, *frame.view, place + side) ||
                !is_covered(*frame.surface, *frame.view, place - side))
                ++found;
            --left;
            if (found >= needed) return true;
            if (found + left < needed) return false;
        }
        arc += length;
    }
    return false;
}

bool LineStubble::is_double(std::uint32_t stroke, const LineOptions& options) const {
    if (!(options.gap > 0.0) || lengths_[stroke] >= k_double_lengths * options.stubble)
        return false;
    // Between places lies no gap that shows. What is shorter is a dot, without a direction.
    const bool is_dot = lengths_[stroke] <= k_double_spacing * options.gap;
    for (std::uint32_t i = first_segments_[stroke]; i < first_segments_[stroke + 1]; ++i) {
        const Segment& own = segments_[i];
        const glm::dvec2 way = is_dot ? glm::dvec2(0.0) : way_at(i, k_double_spacing * options.gap);
        const int parts = parts_of(glm::distance(own.from, own.to), k_double_spacing * options.gap);
        for (int part = 0; part <= parts; ++part)
            if (!has_other_along(stroke, way, glm::mix(own.from, own.to, double(part) / parts),
                                 options.gap))
                return false;
    }
    return true;
}

// Strokes that only hold each other, as the two sides of a sliver, are loose as a closed one of their length is.
void LineStubble::find_loose_groups(const LineOptions& options) {
    DisjointSets groups(lengths_.size());
    const auto is_long = [&](std::uint32_t s) {
        return is_closed_[s] != 0 || lengths_[s] >= options.stubble;
    };
    for (std::uint32_t s = 0; s < lengths_.size(); ++s) {
        if (is_there_[s] == 0 || is_loose_[s] != 0 || is_long(s)) continue;
        for (const glm::dvec2& end :
             {segments_[first_segments_[s]].from, segments_[first_segments_[s + 1] - 1].to})
            grid_.each_cell(end, end, [&](std::uint32_t cell) {
                for (const std::uint32_t i : grid_.segments_in(cell)) {
                    const std::uint32_t other = segments_[i].stroke;
                    if (is_there_[other] != 0 && is_loose_[other] == 0 &&
                        distance_to(segments_[i], end) <= options.gap)
                        groups.join(s, other);
                }
            });
    }
    const std::vector<std::uint32_t> group = groups.take_numbers();
    group_lengths_.assign(lengths_.size(), 0.0);
    group_extents_.assign(lengths_.size(), {});
    has_long_.assign(lengths_.size(), 0);
    for (std::uint32_t s = 0; s < lengths_.size(); ++s) {
        if (is_there_[s] == 0 || is_loose_[s] != 0) continue;
        group_lengths_[group[s]] += lengths_[s];
        group_extents_[group[s]].include(extents_[s]);
        if (is_long(s)) has_long_[group[s]] = 1;
    }
    for (std::uint32_t s = 0; s < lengths_.size(); ++s)
        if (is_there_[s] != 0 && has_long_[group[s]] == 0 &&
            seen_length(group_lengths_[group[s]], group_extents_[group[s]]) < options.stubble)
            is_loose_[s] = 1;
}

// A loose stroke stays where it holds two ends of strokes that are not loose, and no other such stroke does.
void LineStubble::keep_bridges(const LineOptions& options) {
    if (std::ranges::find(is_loose_, 1) == is_loose_.end()) return;
    held_ends_.assign(lengths_.size(), 0);
    for (std::uint32_t s = 0; s < lengths_.size(); ++s) {
        if (is_there_[s] == 0 || is_loose_[s] != 0 || is_closed_[s] != 0) continue;
        for (const glm::dvec2& end :
             {segments_[first_segments_[s]].from, segments_[first_segments_[s + 1] - 1].to}) {
            std::uint32_t holder = k_no_stroke;
            bool is_held = false;
            grid_.each_cell(end, end, [&](std::uint32_t cell) {
                for (const std::uint32_t i : grid_.segments_in(cell)) {
                    const std::uint32_t other = segments_[i].stroke;
                    if (other == s || is_there_[other] == 0 ||
                        distance_to(segments_[i], end) > options.gap)
                        continue;
                    if (is_loose_[other] == 0)
                        is_held = true;
                    else if (holder == k_no_stroke || lengths_[other] > lengths_[holder])
                        holder = other;
                }
            });
            if (!is_held && holder != k_no_stroke) ++held_ends_[holder];
        }
    }
    for (std::uint32_t s = 0; s < lengths_.size(); ++s)
        if (held_ends_[s] >= 2) is_loose_[s] = 0;
}

void LineStubble::choose_staying(const LineOptions& options) {
    std::ranges::fill(stays_, 0);
    for (const std::uint32_t s : order_)
        stays_[s] = is_there_[s] != 0 && is_loose_[s] == 0 && !is_double(s, options);
}

// Where a double is the outline itself, and with it those that go on from it, strokes beside these are doubles of the
// outline, if they can be. Returns whether there is a new one.
bool LineStubble::put_outline_first(const LineFrame& frame, const LineOptions& options) {
    queue_.clear();
    const auto put = [&](std::uint32_t s) {
        if (is_there_[s] == 0 || is_loose_[s] != 0 || is_outline_[s] != Answer::unknown)
            return false;
        is_outline_[s] = answer(is_at_outline(s, frame, options, k_is_outline));
        return is_outline_[s] == Answer::yes;
    };
    for (const std::uint32_t s : order_)
        if (stays_[s] == 0 && put(s)) queue_.push_back(s);
    if (queue_.empty()) return false;
    const std::size_t count = queue_.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t s = queue_[i];
        if (is_closed_[s] != 0) continue;
        neighbors_.clear();
        for (const glm::dvec2& end :
             {segments_[first_segments_[s]].from, segments_[first_segments_[s + 1] - 1].to})
            grid_.each_cell(end, end, [&](std::uint32_t cell) {
                for (const std::uint32_t k : grid_.segments_in(cell))
                    if (distance_to(segments_[k], end) <= options.gap)
                        neighbors_.push_back(segments_[k].stroke);
            });
        std::ranges::sort(neighbors_);
        const auto last = std::ranges::unique(neighbors_);
        neighbors_.erase(last.begin(), last.end());
        for (const std::uint32_t neighbor : neighbors_) put(neighbor);
    }
    std::ranges::stable_partition(order_,
                                  [&](std::uint32_t s) { return is_outline_[s] == Answer::yes; });
    return true;
}

bool LineStubble::is_sharp(EdgeId edge, const LineFrame& frame, const LineOptions& options) {
    return edge == k_no_edge || frame.surface->mesh().edge_class(edge) == EdgeClass::border ||
           frame.surface->bends_rad()[index(edge)] >= options.crease_angle_rad;
}

// The length of what is to be cut off at an end; 0 where nothing is. Strokes in stays_ are the longer ones.
double LineStubble::tail_of(std::uint32_t stroke, bool is_last, const LineFrame& frame,
                            const LineOptions& options) {
    const std::uint32_t first = first_segments_[stroke], last = first_segments_[stroke + 1];
    const double spacing =
        std::max(k_double_spacing * options.gap, k_least_spacing * options.stubble);
    double arc = 0.0;
    bool is_beside = false;
    free_places_.clear();
    for (std::uint32_t k = 0; k < last - first; ++k) {
        const std::uint32_t i = is_last ? last - 1 - k : first + k;
        const glm::dvec2 from = is_last ? segments_[i].to : segments_[i].from;
        const glm::dvec2 to = is_last ? segments_[i].from : segments_[i].to;
        const double length = glm::distance(from, to);
        const glm::dvec2 way = way_at(i, spacing);
        const int parts = parts_of(length, spacing);
        const bool is_smooth = !is_sharp(segments_[i].edge, frame, options);
        for (int part = 0; part < parts; ++part) {
            const double at = arc + length * part / parts;
            const glm::dvec2 place = glm::mix(from, to, double(part) / parts);
            if (at >= k_double_lengths * options.stubble || (!is_smooth && !is_beside)) return 0.0;
            if (is_smooth && has_other_along(stroke, way, place, k_tail_reach * options.gap)) {
                if (!is_beside && !is_tail(stroke, frame, options)) return 0.0;
                is_beside = true;
            } else if (is_beside) {
                return at >= options.gap ? at : 0.0;
            } else if (at >= options.stubble) {
                return 0.0;
            } else {
                free_places_.push_back({place, way});
            }
        }
        arc += length;
    }
    return is_beside ? arc : 0.0;
}

// Whether no place of free_places_ is all that is drawn of an outline.
bool LineStubble::is_tail(std::uint32_t stroke, const LineFrame& frame,
                          const LineOptions& options) const {
    const double reach = options.smooth + k_has_outline.gap_share * options.gap;
    return std::ranges::none_of(free_places_, [&](const StrokePlace& at) {
        const double length = glm::length(at.way);
        if (!(length > 0.0) || is_held(at.place, stroke, reach)) return false;
        const glm::dvec2 side = (reach / length) * glm::dvec2(-at.way.y, at.way.x);
        return !is_covered(*frame.surface, *frame.view, at.place + side) ||
               !is_covered(*frame.surface, *frame.view, at.place - side);
    });
}

double LineStubble::length_of(std::uint32_t stroke) const {
    double length = 0.0;
    for (std::uint32_t i = first_segments_[stroke]; i < first_segments_[stroke + 1]; ++i)
        length += glm::distance(segments_[i].from, segments_[i].to);
    return length;
}

// Keeps the stretch from one length along the stroke to another.
void LineStubble::cut(std::uint32_t stroke, double begin, double end, bool is_orthographic,
                      LineDrawing& drawing) {
    // Its segments, for strokes that are shorter.
    double arc = 0.0;
    for (std::uint32_t i = first_segments_[stroke]; i < first_segments_[stroke + 1]; ++i) {
        Segment& segment = segments_[i];
        const glm::dvec2 from = segment.from, way = segment.to - from;
        const double length = glm::length(way);
        if (length > 0.0) {
            segment.from = from + std::clamp((begin - arc) / length, 0.0, 1.0) * way;
            segment.to = from + std::clamp((end - arc) / length, 0.0, 1.0) * way;
        }
        arc += length;
    }
    // Its parts, each of which begins where the pen comes to after a gap.
    LineStroke& drawn = drawing.strokes[stroke];
    const std::vector<StrokePart> parts(drawing.stroke_parts.begin() + drawn.first_part,
                                        drawing.stroke_parts.begin() + drawn.last_part);
    drawn.first_part = static_cast<std::uint32_t>(drawing.stroke_parts.size());
    drawn.length = 0.0;
    arc = 0.0;
    std::optional<glm::dvec2> before;
    for (StrokePart part : parts) {
        const std::uint32_t count = part.last_point - part.first_point;
        const auto place = [&](std::uint32_t i) {
            return drawing.points[part.is_reversed ? part.last_point - 1 - i : part.first_point + i]
                .position;
        };
        if (before) arc += glm::distance(*before, place(0));
        // Numbers of its points with shares, in the order of the stroke.
        double low = -1.0, high = -1.0;
        for (std::uint32_t i = 0; i + 1 < count; ++i) {
            const double length = glm::distance(place(i), place(i + 1));
            if (length > 0.0 && arc + length > begin && arc < end) {
                if (low < 0.0) low = double(i) + std::max(begin - arc, 0.0) / length;
                high = double(i) + std::min((end - arc) / length, 1.0);
            }
            arc += length;
        }
        before = place(count - 1);
        if (!(low >= 0.0 && high > low)) continue;
        if (low > 0.0 || high < double(count - 1)) {
            const double last = double(count - 1);
            drawn.length += part.is_reversed
                                ? cut_part(last - high, last - low, is_orthographic, part, drawing)
                                : cut_part(low, high, is_orthographic, part, drawing);
        } else {
            drawn.length +=
                drawing.points[part.last_point - 1].arc - drawing.points[part.first_point].arc;
        }
        drawing.stroke_parts.push_back(part);
    }
    drawn.last_part = static_cast<std::uint32_t>(drawing.stroke_parts.size());
}

// Beside strokes that stay, the longest first: a tail is beside a longer one, without the tails of that.
void LineStubble::cut_tails(const LineFrame& frame, const LineOptions& options,
                            LineDrawing& drawing) {
    if (!(options.gap > 0.0)) return;
    std::ranges::fill(stays_, 0);
    for (const std::uint32_t s : order_) {
        if (is_there_[s] == 0) continue;
        if (is_closed_[s] == 0) {
            const double length = length_of(s);
            const double begin = tail_of(s, false, frame, options);
            const double end = length - (begin < length ? tail_of(s, true, frame, options) : 0.0);
            // What is left between two tails may be a dot.
            if (begin >= end || (begin > 0.0 && end < length && end - begin < options.gap)) {
                is_there_[s] = 0;
                continue;
            }
            if (begin > 0.0 || end < length) {
                cut(s, begin, end, frame.view->is_orthographic(), drawing);
                if (drawing.strokes[s].length < options.min_length) {
                    is_there_[s] = 0;
                    continue;
                }
            }
        }
        stays_[s] = 1;
    }
}

// Strokes that are gone hold no others, so there are rounds.
void LineStubble::remove(const LineFrame& frame, const LineOptions& options, LineDrawing& drawing) {
    fill(options.gap, drawing);
    const std::size_t count = drawing.strokes.size();
    // The longest first: a stroke is the double of strokes that stay.
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::stable_sort(order_, std::ranges::greater{},
                             [&](std::uint32_t s) { return lengths_[s]; });
    has_outline_.assign(count, Answer::unknown);
    is_there_.assign(count, 1);
    is_loose_.assign(count, 0);
    stays_.assign(count, 0);
    is_outline_.assign(count, Answer::unknown);
    for (bool is_done = false; !is_done;) {
        for (const std::uint32_t s : order_)
            is_loose_[s] = is_there_[s] != 0 && is_loose(s, options);
        find_loose_groups(options);
        keep_bridges(options);
        for (const std::uint32_t s : order_) {
            if (is_loose_[s] == 0) continue;
            if (has_outline_[s] == Answer::unknown)
                has_outline_[s] = answer(is_at_outline(s, frame, options, k_has_outline));
            if (has_outline_[s] == Answer::yes) is_loose_[s] = 0;
        }
        choose_staying(options);
        if (put_outline_first(frame, options)) choose_staying(options);
        is_done = stays_ == is_there_;
        is_there_ = stays_;
    }
    cut_tails(frame, options, drawing);
    std::size_t kept = 0;
    for (std::uint32_t s = 0; s < count; ++s)
        if (is_there_[s] != 0) drawing.strokes[kept++] = drawing.strokes[s];
    drawing.strokes.resize(kept);
}

}  // namespace rimline
