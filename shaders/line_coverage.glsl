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

// The share of a pixel that lies farther than `away` >= 0 from its middle, on one side of a straight edge. The edge's
// unit normal has the components `wide` >= `narrow` > 0.
float share_beyond(float away, float wide, float narrow) {
    const float rest = max(0.5 * (wide + narrow) - away, 0.0);
    return rest > narrow ? 0.5 - away / wide : 0.5 * rest * rest / (wide * narrow);
}

// The coverage of a pixel at `away` pixels from the nearest place of a segment: exactly the area of the band around
// the segment's line in it, so that a line has the same ink at every angle. Round ends use the same normal, so
// segments of one line agree where they meet.
float covered_across(vec4 ends, float away) {
    const float radius = frame.line_radius;
    const vec2 along = abs(ends.zw - ends.xy);
    const float len = length(along);
    const vec2 normal = len > 1e-6 ? along / len : vec2(1.0, 0.0);
    const float wide = max(normal.x, normal.y);
    const float narrow = max(min(normal.x, normal.y), 1e-4);
    const float inside = radius - away;
    const float beyond = share_beyond(abs(inside), wide, narrow);
    return (inside < 0.0 ? beyond : 1.0 - beyond) - share_beyond(radius + away, wide, narrow);
}

// The dash pattern's coverage at `place` along it.
float dash_at(float place) {
    const float period = frame.dash_period;
    if (period == 0.0) return 1.0;
    const float from_center = abs(fract(place / period) - 0.5) * period;
    return clamp(0.5 * frame.dash_length + 0.5 - from_center, 0.0, 1.0);
}

#endif
