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

// The coverage of a pixel at `away` pixels from the nearest place of a segment. The ink's edge falls off over the
// width of a pixel as seen along the segment, so that a line has the same ink at every angle: a fixed width of one
// pixel loses up to a twentieth of it on the diagonal. It is one width for all of the segment, round ends too:
// segments of one line then agree where they meet.
float covered_across(vec4 ends, float away) {
    const float radius = frame.line_radius;
    const vec2 along = abs(ends.zw - ends.xy);
    const float len = length(along);
    const float half_pixel = len > 1e-6 ? 0.5 * (along.x + along.y) / len : 0.5;
    return clamp(0.5 * (radius + half_pixel - away) / half_pixel, 0.0, min(radius / half_pixel, 1.0));
}

// The dash pattern's coverage at `place` along it.
float dash_at(float place) {
    const float period = frame.dash_period;
    if (period == 0.0) return 1.0;
    const float from_center = abs(fract(place / period) - 0.5) * period;
    return clamp(0.5 * frame.dash_length + 0.5 - from_center, 0.0, 1.0);
}

#endif
