#version 460
#extension GL_GOOGLE_include_directive : require
#include "line_coverage.glsl"

// The ink of one capsule: its coverage of this pixel, in alpha. Blending keeps the maximum, so neighbors
// join without seams. If the spine is hidden, the coverage is multiplied by the strength of hidden lines.
//
// Visibility is tested at the line's spine, not at the inked pixel, because half of the line covers its
// own surface, which bulges towards the viewer (the spine test of Cole and Finkelstein, Two Fast Methods
// for High-Quality Line Visibility, 2010). At a silhouette the surface ends, so an occluder is visible on
// the outer side. The test extrapolates the surface there to the spine, as a plane. (Without
// extrapolation, the farthest depth around the spine shows hidden lines close behind a slanted surface:
// for example dots at the base of an object that stands in the ground.) A crease has its own faces on both
// sides. It is visible if the test succeeds on either side.

layout(location = 0) flat in vec4 ends;        // Start and end, in pixels.
layout(location = 1) flat in vec4 depths_out;  // Depths at both ends; the unit vector outwards.
layout(location = 2) flat in vec3 pattern;     // Dashes at both ends; whether to test both sides.
layout(location = 0) out vec4 coverage;

layout(set = 1, binding = 0) uniform sampler2D surface_depth;

float depth_at(ivec2 pixel) {
    return texelFetch(surface_depth, clamp(pixel, ivec2(0), ivec2(frame.extent) - 1), 0).r;
}

float smaller(float a, float b) { return abs(a) < abs(b) ? a : b; }

// Whether the surface at `spine + offset`, extrapolated to `spine`, is not in front of depth `nearest`
// (greater is nearer). Depth is linear on the screen for a plane surface. The slope comes from pixels
// farther outwards only, because the line's own surface begins inwards. The smaller of two differences is
// the slope. The other may be a step to another surface. The difference of the two measures how far the
// surface is from a plane. It is tolerated if the line is in front of the surface at `spine + offset`.
bool is_free(vec2 spine, vec2 offset, vec2 outwards, float nearest) {
    const vec2 place = frame.depth_place;
    const ivec2 pixel = ivec2(floor(spine + offset - place + 0.5));
    const ivec2 x = ivec2(outwards.x < 0.0 ? -1 : 1, 0);
    const ivec2 y = ivec2(0, outwards.y < 0.0 ? -1 : 1);
    const float depth = depth_at(pixel);
    const float x_1 = depth_at(pixel + x) - depth;
    const float x_2 = depth_at(pixel + 2 * x) - depth - x_1;
    const float y_1 = depth_at(pixel + y) - depth;
    const float y_2 = depth_at(pixel + 2 * y) - depth - y_1;
    const vec2 back = spine - (vec2(pixel) + place);
    const float continued = depth + back.x * float(x.x) * smaller(x_1, x_2) +
                            back.y * float(y.y) * smaller(y_1, y_2);
    if (continued <= nearest) return true;
    return depth <= nearest && continued - abs(x_2 - x_1) - abs(y_2 - y_1) <= nearest;
}

// Whether the line is free on the side of `outwards`, or on either side. Tests straight outwards first,
// then obliquely to both sides, because the surface of another line may begin near the line's end. A CPU
// device leaves a loop early but executes both sides of every branch, so this is a loop. Most lines are
// free at the first test.
bool is_free_on(vec2 spine, vec2 outwards, bool on_both_sides, float nearest) {
    const vec2 turned = vec2(-outwards.y, outwards.x);
    const vec2 offsets[4] = vec2[](1.25 * outwards, 0.8 * outwards, 0.9 * (outwards + turned),
                                 0.9 * (outwards - turned));
    const int count = on_both_sides ? 8 : 4;
    for (int i = 0; i < count; ++i) {
        const float side = i < 4 ? 1.0 : -1.0;
        if (is_free(spine, side * offsets[i & 3], side * outwards, nearest)) return true;
    }
    return false;
}

void main() {
    const float t = share_along(ends, gl_FragCoord.xy);
    const vec2 spine = ends.xy + t * (ends.zw - ends.xy);
    const float covered = covered_across(ends, distance(gl_FragCoord.xy, spine));
    if (covered == 0.0) discard;

    const float depth = mix(depths_out.x, depths_out.y, t);
    const float nearest_seen =
        depth + depth * frame.depth_slack + frame.depth_slack_absolute;
    const vec2 outwards = depths_out.zw;
    const bool seen = is_free_on(spine, outwards, pattern.z != 0.0, nearest_seen);
    const float strength =
        seen ? 1.0 : frame.hidden_strength * dash_at(mix(pattern.x, pattern.y, t));
    coverage = vec4(0.0, 0.0, 0.0, covered * strength);
}
