#include "tools/output/plot_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "silhouette/error.h"

namespace rimline::tools {

namespace {

// 1, 2 or 5 times a power of ten: the greatest that is at most `most`.
double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= most) return factor * power;
    return power;
}

}  // namespace

double round_step(double range, int steps) {
    RIMLINE_CHECK(range > 0.0 && steps > 0);
    const double least = range / steps;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least) return factor * power;
    return 10.0 * power;
}

std::vector<double> round_ticks(double low, double high, int steps) {
    const double step = round_step(high - low, steps);
    std::vector<double> ticks;
    // By count: beyond 2^53 numbers have no next one.
    const double first = std::ceil(low / step);
    const int last = static_cast<int>(std::min(std::floor(high / step) - first, double(steps)));
    for (int i = 0; i <= last; ++i) ticks.push_back((first + i) * step + 0.0);  // No -0.
    return ticks;
}

std::string short_number(double value, double step) {
    char text[32];
    // A step that is a power of ten, give or take rounding.
    const int digits = step > 0.0 ? -static_cast<int>(std::floor(std::log10(step) + 1e-9)) : 2;
    if (digits > 5 || std::abs(value) >= 1e9) {
        const int first = value != 0.0 && std::isfinite(value)
                              ? static_cast<int>(std::floor(std::log10(std::abs(value))))
                              : 0;
        std::snprintf(text, sizeof text, "%.*g", std::clamp(first + digits + 1, 3, 15), value);
    } else {
        std::snprintf(text, sizeof text, "%.*f", std::max(digits, 0), value);
    }
    return text;
}

void draw_scale_bar(Canvas& canvas, int left, int bottom, int max_width, double pixels_per_unit,
                    const std::string& label, Color color, int scale) {
    const double length = round_length(max_width / pixels_per_unit);
    const int width = static_cast<int>(std::lround(length * pixels_per_unit));
    const int end = 3 * scale;
    canvas.fill(left, bottom - end / 2 - scale / 2, width, scale, color);
    canvas.fill(left, bottom - end, scale, end, color);
    canvas.fill(left + width - scale, bottom - end, scale, end, color);
    canvas.write(left, bottom - end - Canvas::text_height(scale) - 3 * scale,
                 short_number(length, length) + label, color, scale);
}

void draw_axis_cross(Canvas& canvas, int center_x, int center_y,
                     const std::array<glm::dvec3, 3>& ends, double length, Color color, int scale) {
    const glm::dvec2 center(center_x, center_y);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const glm::dvec2 along(ends[axis].x, -ends[axis].y);
        canvas.line(center, center + length * along, scale, color);
        // Beyond the end, and not over the others where the axis goes along the view.
        const double in_view = glm::length(along);
        const glm::dvec2 beyond = in_view > 0.1 ? along / in_view : glm::dvec2(-0.7, 0.7);
        const glm::dvec2 name = center + length * along + 7.0 * scale * beyond;
        canvas.write(static_cast<int>(std::lround(name.x)) - 2 * scale,
                     static_cast<int>(std::lround(name.y)) - 4 * scale,
                     std::string(1, static_cast<char>('x' + axis)), color, scale);
    }
}

}  // namespace rimline::tools
