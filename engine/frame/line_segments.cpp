#include "engine/frame/line_segments.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "silhouette/error.h"

namespace rimline {

namespace {

// The position in the dash pattern of a place of a line is begin + rate * (the length of the line up to there).
// line_coverage.glsl has the center of a dash at half a period.
struct DashPattern {
    double begin, rate;
};

// The same place of the pattern everywhere: a line without gaps.
DashPattern solid(double period) { return {0.5 * period, 0.0}; }

// A dash ends over a pixel. The ends of the line lie half a pixel inside, so that they have all of their ink.
DashPattern fitted_dashes(double length, bool is_closed, double period, double dash) {
    const double begin = 0.5 * (period - dash) + std::min(0.5, 0.5 * dash);
    const double last =
        is_closed ? 0.0 : std::max(dash - 1.0, 0.0);  // After the last whole period.
    const double periods = std::round((length - last) / period);
    if (!(periods >= 1.0)) return solid(period);
    return {begin, (periods * period + last) / length};
}

// Squares of lengths stay finite.
constexpr double k_max_pixel = 1e30;

class SegmentMaker {
public:
    SegmentMaker(const gpu::FrameData& frame, std::vector<gpu::LineSegment>& segments)
        : frame_(frame),
          reach_(double{frame.line_radius} + RIMLINE_INK_REACH),
          segments_(segments) {}

    void add(const PictureLines& lines, const PictureLine& line) {
        RIMLINE_CHECK(line.first_point < line.last_point && line.last_point <= lines.points.size());
        pixels_.clear();
        for (std::uint32_t i = line.first_point; i < line.last_point; ++i) {
            const glm::dvec2 pixel = pixel_of(lines.points[i]);
            RIMLINE_CHECK(std::abs(pixel.x) < k_max_pixel && std::abs(pixel.y) < k_max_pixel);
            pixels_.push_back(pixel);
        }
        if (line.is_closed || pixels_.size() == 1) pixels_.push_back(pixels_.front());
        DashPattern pattern = solid(double{frame_.dash_period});
        if (line.is_hidden && frame_.dash_period > 0.0f)
            pattern = fitted_dashes(length(), line.is_closed, double{frame_.dash_period},
                                    double{frame_.dash_length});
        const float strength = line.is_hidden ? frame_.hidden_strength : 1.0f;
        double arc = 0.0;
        for (std::size_t i = 0; i + 1 < pixels_.size(); ++i) {
            const double next = arc + glm::distance(pixels_[i], pixels_[i + 1]);
            add_segment(pixels_[i], pixels_[i + 1],
                        glm::dvec2(pattern.begin) + pattern.rate * glm::dvec2(arc, next), strength);
            arc = next;
        }
    }

private:
    glm::dvec2 pixel_of(const glm::dvec2& point) const {
        const glm::dvec2 scale = glm::dvec2(frame_.clip_scale) * double{frame_.guard};
        const glm::dvec2 shift = glm::dvec2(frame_.clip_shift) * double{frame_.guard};
        return (0.5 * (scale * point + shift) + 0.5) * glm::dvec2(frame_.extent);
    }

    double length() const {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < pixels_.size(); ++i)
            sum += glm::distance(pixels_[i], pixels_[i + 1]);
        return sum;
    }

    // Cut at the widened picture, in double: a float of a place far outside would not have a pixel's precision.
    void add_segment(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& dashes,
                     float strength) {
        double first = 0.0, last = 1.0;
        const auto cut = [&](double at_a, double at_b) {  // To where both are at least 0.
            if (at_a < 0.0 && at_b < 0.0) last = -1.0;
            if (at_a < 0.0 && at_b >= 0.0) first = std::max(first, at_a / (at_a - at_b));
            if (at_a >= 0.0 && at_b < 0.0) last = std::min(last, at_a / (at_a - at_b));
        };
        for (int axis = 0; axis < 2; ++axis) {
            const double low = -reach_, high = double{frame_.extent[axis]} + reach_;
            cut(a[axis] - low, b[axis] - low);
            cut(high - a[axis], high - b[axis]);
        }
        if (first > last) return;
        segments_.push_back({.ends = glm::vec4(glm::mix(a, b, first), glm::mix(a, b, last)),
                             .dashes = glm::vec2(glm::mix(dashes.x, dashes.y, first),
                                                 glm::mix(dashes.x, dashes.y, last)),
                             .strength = strength});
    }

    const gpu::FrameData& frame_;
    double reach_;  // Beyond the picture, in pixels.
    std::vector<gpu::LineSegment>& segments_;
    std::vector<glm::dvec2> pixels_;
};

}  // namespace

void add_line_segments(const PictureLines& lines, std::uint32_t color, const gpu::FrameData& frame,
                       std::vector<gpu::LineSegment>& segments) {
    SegmentMaker maker(frame, segments);
    for (const PictureLine& line : lines.lines)
        if (line.color == color && (!line.is_hidden || frame.hidden_strength > 0.0f))
            maker.add(lines, line);
}

}  // namespace rimline
