#include "silhouette/lines/coincident_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace rimline {

namespace {

constexpr std::uint32_t k_no_stretch = 0xffffffffu;
// Seen from the eye, and not from the point beside it, lines coincide that are so near to each other from there.
constexpr double k_shifts = 4.0;

// The direction of a line, of which both ways are one: half a turn has 2^16 steps, which are at least as dense as
// angles of pi / 2^16 are, and at most twice as dense.
std::uint16_t direction_of(glm::dvec2 way) {
    if (way.y < 0.0) way = -way;
    const double share = way.y / (std::abs(way.x) + way.y);  // Of a quarter turn.
    return static_cast<std::uint16_t>(
        static_cast<std::uint32_t>(0x8000 * (way.x < 0.0 ? 2.0 - share : share)));
}

// The sine of the turn is at most twice the tolerance over the length. Two steps are for rounding.
std::uint16_t most_turn_of(double length, double tolerance) {
    const double sine = 2.0 * tolerance / std::max(length, 1e-300);
    return static_cast<std::uint16_t>(sine < 0.1 ? 0x8800 * sine + 2.0 : 0x8000);
}

}  // namespace

void CoincidentLines::find(const LineFrame& frame, CoveredStretches& covered) {
    covered.clear();
    if (frame.lines.empty()) return;
    const double tolerance = k_shifts * LineView::k_shift *
                             (frame.view->is_orthographic() ? frame.surface->mesh().radius() : 1.0);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    double length = 0.0;
    stretches_.clear();
    hidden_.clear();
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        if (!frame.lines[i].is_drawn) continue;
        const FlatLine& flat = frame.flats[i];
        double begin = 0.0;
        std::int32_t count = frame.first_counts[i];
        const auto add = [&](double end) {
            if (end <= begin) return;
            const glm::dvec2 from = glm::mix(flat.ends[0], flat.ends[1], begin);
            const glm::dvec2 to = glm::mix(flat.ends[0], flat.ends[1], end);
            const glm::dvec2 way = to - from;
            const double own_length = glm::length(way);
            (count > 0 ? hidden_ : stretches_)
                .push_back({i,
                            {from, to},
                            begin,
                            end,
                            own_length,
                            own_length > tolerance ? direction_of(way) : std::uint16_t{0},
                            most_turn_of(own_length, tolerance)});
            low = glm::min(low, glm::min(from, to));
            high = glm::max(high, glm::max(from, to));
            length += own_length;
        };
        for (const LineEvent& event : frame.events_of(i)) {
            if ((count > 0) != (count + event.jump > 0)) {
                add(event.share);
                begin = event.share;
            }
            count += event.jump;
        }
        add(1.0);
    }
    stretches_.insert(stretches_.end(), hidden_.begin(), hidden_.end());
    if (stretches_.empty()) return;
    const double size = double(stretches_.size());
    grid_.reset(low, high,
                std::max({0.5 * length / size, 4.0 * tolerance,
                          0.5 * std::sqrt((high.x - low.x) * (high.y - low.y) / (8.0 * size))}),
                tolerance);
    for (std::uint32_t i = 0; i < stretches_.size(); ++i)
        grid_.add(i, stretches_[i].ends[0], stretches_[i].ends[1]);
    grid_.finish();
    const PictureSteps steps(low, high);
    boxes_.clear();
    for (const std::uint32_t i : grid_.all_segments()) {
        const Stretch& stretch = stretches_[i];
        boxes_.push_back({steps.box(stretch.ends[0], stretch.ends[1], tolerance), i,
                          stretch.direction, stretch.most_turn});
    }

    tested_.assign(stretches_.size(), k_no_stretch);
    found_.clear();
    for (std::uint32_t i = 0; i < stretches_.size(); ++i) {
        const Stretch& own = stretches_[i];
        const double own_length = own.length;
        if (own_length <= tolerance) {  // Seen end-on: a point.
            found_.push_back({own.line, own.begin, own.end});
            continue;
        }
        const glm::dvec2 along = (own.ends[1] - own.ends[0]) / own_length;
        const PictureQuery box = steps.query(own.ends[0], own.ends[1]);
        const auto may_be_parallel = [direction = own.direction](const Box& other) {
            const auto turn = static_cast<std::int16_t>(other.direction - direction);
            return std::abs(int{turn}) <= int{other.most_turn};
        };
        const auto visit = [&](std::uint32_t j) {
            const Stretch& other = stretches_[j];
            if (tested_[j] == i || other.line == own.line) return;
            tested_[j] = i;
            const glm::dvec2 a = other.ends[0] - own.ends[0], b = other.ends[1] - own.ends[0];
            const double height_a = along.x * a.y - along.y * a.x;
            const double height_b = along.x * b.y - along.y * b.x;
            if (std::abs(height_a) > tolerance || std::abs(height_b) > tolerance) return;
            double first = glm::dot(along, a), last = glm::dot(along, b);
            if (first > last) std::swap(first, last);
            first = std::max(first, 0.0);
            last = std::min(last, own_length);
            // Lines that share an end and go on overlap in less than the tolerance.
            if (last - first <= 2.0 * tolerance) return;
            const auto share_at = [&](double place) {
                return own.begin + (own.end - own.begin) * (place / own_length);
            };
            found_.push_back({own.line, first <= tolerance ? own.begin : share_at(first),
                              last >= own_length - tolerance ? own.end : share_at(last)});
        };
        grid_.each_cell(own.ends[0], own.ends[1], [&](std::uint32_t cell) {
            const std::uint32_t end = grid_.begin_of(cell + 1);
            for (std::uint32_t k = grid_.begin_of(cell); k < end && boxes_[k].stretch < i; ++k)
                if (may_meet(boxes_[k].area, box) && may_be_parallel(boxes_[k]))
                    visit(boxes_[k].stretch);
        });
    }
    if (found_.empty()) return;
    std::sort(found_.begin(), found_.end(), [](const CoveredStretch& a, const CoveredStretch& b) {
        return a.line != b.line ? a.line < b.line : a.begin < b.begin;
    });
    covered.begin_.assign(frame.lines.size() + 1, 0);
    for (const CoveredStretch& stretch : found_) {
        if (!covered.stretches_.empty() && covered.stretches_.back().line == stretch.line &&
            covered.stretches_.back().end >= stretch.begin) {
            covered.stretches_.back().end = std::max(covered.stretches_.back().end, stretch.end);
            continue;
        }
        covered.stretches_.push_back(stretch);
        ++covered.begin_[stretch.line + 1];
    }
    for (std::size_t i = 0; i < frame.lines.size(); ++i) covered.begin_[i + 1] += covered.begin_[i];
}

}  // namespace rimline
