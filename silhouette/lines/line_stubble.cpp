#include "silhouette/lines/line_stubble.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace rimline {

namespace {

// Doubles are shorter than this many times LineOptions::stubble.
constexpr double k_double_lengths = 6.0;

}  // namespace

void LineStubble::fill(double gap, const LineDrawing& drawing) {
    segments_.clear();
    first_segments_.assign(1, 0);
    lengths_.clear();
    is_closed_.clear();
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (std::uint32_t s = 0; s < drawing.strokes.size(); ++s) {
        const LineStroke& stroke = drawing.strokes[s];
        for (const StrokePart& part : drawing.parts_of(stroke)) {
            const std::span<const LinePoint> points = drawing.points_of(drawing.runs[part.run]);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const std::size_t at = part.is_reversed ? points.size() - 1 - i : i;
                const glm::dvec2& from = points[at].position;
                const glm::dvec2& to = points[part.is_reversed ? at - 1 : at + 1].position;
                segments_.push_back({from, to, s, false, false});
                low = glm::min(low, glm::min(from, to));
                high = glm::max(high, glm::max(from, to));
            }
        }
        if (!stroke.is_closed && segments_.size() > first_segments_.back()) {
            segments_[first_segments_.back()].begins_stroke = true;
            segments_.back().ends_stroke = true;
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

bool LineStubble::is_beside(const glm::dvec2& place, std::uint32_t stroke, double reach,
                            bool must_be_longer) const {
    const auto is_near = [&](const Segment& segment) {
        const std::uint32_t other = segment.stroke;
        if (other == stroke) return false;
        const bool is_longer = lengths_[other] > lengths_[stroke] ||
                               (lengths_[other] == lengths_[stroke] && other < stroke);
        if (must_be_longer && !is_longer) return false;
        const glm::dvec2 way = segment.to - segment.from;
        const double square = std::max(glm::dot(way, way), 1e-300);
        const double share = glm::dot(place - segment.from, way) / square;
        // Before the end of a stroke lies no double of it, but what goes on from there.
        if (must_be_longer &&
            ((segment.begins_stroke && share < 0.0) || (segment.ends_stroke && share > 1.0)))
            return false;
        return glm::distance(place, segment.from + std::clamp(share, 0.0, 1.0) * way) <= reach;
    };
    bool found = false;
    grid_.each_cell(place, place, [&](std::uint32_t cell) {
        for (const std::uint32_t i : grid_.segments_in(cell))
            found = found || is_near(segments_[i]);
    });
    return found;
}

bool LineStubble::is_loose(std::uint32_t stroke, const LineOptions& options) const {
    if (lengths_[stroke] >= 2.0 * options.stubble) return false;
    if (is_closed_[stroke] != 0) return lengths_[stroke] < options.stubble;
    const auto is_held = [&](const glm::dvec2& end) {
        return is_beside(end, stroke, options.gap, false);
    };
    const int loose_ends = int(!is_held(segments_[first_segments_[stroke]].from)) +
                           int(!is_held(segments_[first_segments_[stroke + 1] - 1].to));
    return lengths_[stroke] < loose_ends * options.stubble;
}

bool LineStubble::is_double(std::uint32_t stroke, const LineOptions& options) const {
    if (!(options.gap > 0.0) || lengths_[stroke] >= k_double_lengths * options.stubble)
        return false;
    // At places no farther from each other than the strokes are.
    for (std::uint32_t i = first_segments_[stroke]; i < first_segments_[stroke + 1]; ++i) {
        const auto& [from, to, number, begins, ends] = segments_[i];
        const int parts = 1 + static_cast<int>(glm::distance(from, to) / options.gap);
        for (int part = 0; part <= parts; ++part)
            if (!is_beside(glm::mix(from, to, double(part) / parts), stroke, options.gap, true))
                return false;
    }
    return true;
}

void LineStubble::remove(const LineOptions& options, LineDrawing& drawing) {
    for (;;) {
        fill(options.gap, drawing);
        std::size_t kept = 0;
        for (std::uint32_t s = 0; s < lengths_.size(); ++s) {
            const bool is_stubble = first_segments_[s] == first_segments_[s + 1] ||
                                    is_loose(s, options) || is_double(s, options);
            if (!is_stubble) drawing.strokes[kept++] = drawing.strokes[s];
        }
        if (kept == drawing.strokes.size()) return;
        drawing.strokes.resize(kept);
    }
}

}  // namespace rimline
