#ifndef RIMLINE_SHADERS_LINE_COVERAGE_GLSL
#define RIMLINE_SHADERS_LINE_COVERAGE_GLSL

// The ink of a capsule at a pixel.

#include "draw.glsl"

// The place nearest to `pixel` on a segment, as a share of its way from ends.xy to ends.zw.
float share_along(vec4 ends, vec2 pixel) {
    const vec2 along = ends.zw - ends.xy;
    const float length_squared = dot(along, along);
    return length_squared > 1e-12 ? clamp(dot(pixel - ends.xy, along) / length_squared, 0.0, 1.0)
                                  : 0.0;
}

// The coverage, across the line, of a pixel at `away` pixels from the line's center, with a box filter of
// one pixel.
float covered_across(float away) {
    const float radius = frame.line_radius;
    return min(clamp(radius + 0.5 - away, 0.0, 1.0), 2.0 * radius);
}

// The dash pattern's coverage at `place` along it.
float dash_at(float place) {
    const float period = frame.dash_period;
    if (period == 0.0) return 1.0;
    const float from_center = abs(fract(place / period) - 0.5) * period;
    return clamp(0.5 * frame.dash_length + 0.5 - from_center, 0.0, 1.0);
}

#endif
