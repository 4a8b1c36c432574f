#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// The ink of one capsule: how much of this pixel it covers, in alpha, which keeps its maximum, so neighbors
// join without seams. Where its spine is hidden that is as much less as hidden lines are fainter.
//
// Whether a line is seen is asked of its spine, not of the pixel it inks, for a line lies half over the
// surface that bulges towards the viewer beside it (the spine test of Cole and Finkelstein, Two Fast
// Methods for High-Quality Line Visibility, 2010). At a silhouette the surface ends, so what hides it
// is seen on its outer side: the surface there, continued to the spine as the plane it is near there.
// (The farthest depth around the spine, uncontinued, shows lines that lie less behind a slanted surface
// than it falls off within a pixel: the foot of a thing that stands in the ground, dotted.)
// A crease has its own faces on both sides; it is seen where either says so.

layout(location = 0) flat in vec4 ends;        // From and to, in pixels.
layout(location = 1) flat in vec4 depths_out;  // Depths at both ends; the unit vector outwards.
layout(location = 2) flat in vec3 pattern;     // Dashes at both ends; whether to look on both sides.
layout(location = 0) out vec4 coverage;

layout(set = 1, binding = 0) uniform sampler2D surface_depth;

float depth_at(ivec2 pixel) {
    return texelFetch(surface_depth, clamp(pixel, ivec2(0), ivec2(frame.extent) - 1), 0).r;
}

float smaller(float a, float b) { return abs(a) < abs(b) ? a : b; }

// Whether nothing in front of depth `nearest` (greater is nearer) hides `spine`, as far as one can tell
// from the surface at `spine + offset`. Depth is linear on the screen where a surface is plane; the
// slope is taken from pixels farther outwards only, for inwards the line's own surface begins. Of two
// differences the smaller is a slope, the other may be a step to another surface; as much as they differ
// the surface is not plane, and then a line in front of what is seen there may be free.
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

// Whether the line is free on the side of `outwards`, or on either. Straight out first, then to both sides
// of that: near the end of a line another one's surface may begin. A loop, for a CPU that stands in for a
// GPU leaves one early, and takes both sides of every branch; most lines are free at the first look.
bool is_free_on(vec2 spine, vec2 outwards, bool on_both_sides, float nearest) {
    const vec2 turned = vec2(-outwards.y, outwards.x);
    const vec2 looks[4] = vec2[](1.25 * outwards, 0.8 * outwards, 0.9 * (outwards + turned),
                                 0.9 * (outwards - turned));
    const int count = on_both_sides ? 8 : 4;
    for (int i = 0; i < count; ++i) {
        const float side = i < 4 ? 1.0 : -1.0;
        if (is_free(spine, side * looks[i & 3], side * outwards, nearest)) return true;
    }
    return false;
}

// What of a pixel `away` pixels from a line's middle the line covers, across: a box a pixel wide.
float covered_across(float away) {
    const float radius = frame.line_radius;
    return min(clamp(radius + 0.5 - away, 0.0, 1.0), 2.0 * radius);
}

// How much of the dash pattern is drawn at `place` along it.
float dash_at(float place) {
    const float period = frame.dash_period;
    if (period == 0.0) return 1.0;
    const float from_middle = abs(fract(place / period) - 0.5) * period;
    return clamp(0.5 * frame.dash_length + 0.5 - from_middle, 0.0, 1.0);
}

void main() {
    const vec2 along = ends.zw - ends.xy;
    const float length_squared = dot(along, along);
    const float t = length_squared > 1e-12
        ? clamp(dot(gl_FragCoord.xy - ends.xy, along) / length_squared, 0.0, 1.0) : 0.0;
    const vec2 spine = ends.xy + t * along;
    const float covered = covered_across(distance(gl_FragCoord.xy, spine));
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
