#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// The ink of one capsule: how much of this pixel it covers, in the red channel where its spine is seen
// and in the green where it is hidden. Channels keep their maximum, so neighbours join without seams.
//
// Whether a line is seen is asked of its spine, not of the pixel it inks, for a line lies half over the
// surface that bulges towards the viewer beside it (the spine test of Cole and Finkelstein, Two Fast
// Methods for High-Quality Line Visibility, 2010). At a silhouette the surface ends, so one of the nine
// pixels around the spine lies behind it; it is hidden only where all nine are in front.

layout(location = 0) flat in vec2 from_pixel;
layout(location = 1) flat in vec2 to_pixel;
layout(location = 2) flat in vec2 depths;
layout(location = 0) out vec2 coverage;

layout(set = 0, binding = 0) uniform sampler2D surface_depth;

void main() {
    const vec2 along = to_pixel - from_pixel;
    const float length_squared = dot(along, along);
    const float t = length_squared > 1e-12
        ? clamp(dot(gl_FragCoord.xy - from_pixel, along) / length_squared, 0.0, 1.0) : 0.0;
    const vec2 spine = from_pixel + t * along;
    const float covered =
        clamp(draw.frame.data.line_radius + 0.5 - distance(gl_FragCoord.xy, spine), 0.0, 1.0);
    if (covered == 0.0) discard;

    const float depth = mix(depths.x, depths.y, t);
    const float nearest_seen =
        depth + depth * draw.frame.data.depth_slack + draw.frame.data.depth_slack_absolute;
    const ivec2 last = ivec2(draw.frame.data.viewport) - 1;
    const ivec2 center = ivec2(floor(spine));
    bool seen = false;
    for (int y = -1; y <= 1 && !seen; ++y)
        for (int x = -1; x <= 1 && !seen; ++x) {
            const ivec2 pixel = clamp(center + ivec2(x, y), ivec2(0), last);
            seen = texelFetch(surface_depth, pixel, 0).r <= nearest_seen;  // Reversed: greater is nearer.
        }
    coverage = seen ? vec2(covered, 0.0) : vec2(0.0, covered);
}
