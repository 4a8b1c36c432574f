#pragma once

// What makes a drawing a plot: round numbers along axes, bars of a round length, and crosses of axes.

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/output/canvas.h"

namespace rimline::tools {

/// 1, 2 or 5 times a power of ten: the least at which `range` has at most `steps`. Both are greater than 0.
double round_step(double range, int steps);

/// The multiples of round_step() in [low, high].
std::vector<double> round_ticks(double low, double high, int steps);

/// A number with as many digits as distinguish multiples of `step`.
std::string short_number(double value, double step);

/// A bar of a round length in the model's units, at most `max_width` pixels wide, with the length above it.
/// `bottom` is that of the bar. `label` follows the number.
void draw_scale_bar(Canvas& canvas, int left, int bottom, int max_width, double pixels_per_unit,
                    const std::string& label, Color color, int scale);

/// The axes x, y and z as lines from a point. `ends`: of unit vectors, in the picture: right, up and towards the
/// viewer. `length`: of an axis across the view, in pixels.
void draw_axis_cross(Canvas& canvas, int center_x, int center_y,
                     const std::array<glm::dvec3, 3>& ends, double length, Color color, int scale);

}  // namespace rimline::tools
