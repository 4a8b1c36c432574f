#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

// Steps of depth and of normals in the image of shapes (shape.frag), as coverage of lines in alpha.
//
// The Sobel operator compares both sides of a pixel, with the weights 1, 2, 1. It is divided by their sum: a step
// between the sides has its own height. Depth also changes along a slanted surface, by the tangent of its angle for
// each pixel. What the normal explains is no step.

layout(push_constant, scalar) uniform Constants { SobelConstants sobel; };
layout(set = 0, binding = 0, scalar) uniform FrameBlock { FrameData frame; };
layout(set = 1, binding = 0) uniform sampler2D shapes;

layout(location = 0) out vec4 coverage;

// The steepest slope that is taken from a normal, a tangent of 87 degrees: that of a grazing one would hide all
// steps.
const float k_max_slope = 20.0;

bool is_shape(vec4 shape) { return dot(shape.xyz, shape.xyz) > 0.25; }

// The tangent of the angle between a surface and the plane across the ray of a pixel.
float slope_of(vec3 normal, vec2 pixel) {
    const vec2 ndc = (2.0 * pixel / frame.extent - 1.0) / frame.guard;
    const bool is_orthographic = frame.clip_w.x == 0.0;
    const vec2 aside =
        is_orthographic ? vec2(0.0) : (ndc - frame.clip_shift) / frame.clip_scale;
    const float facing = abs(dot(normal, vec3(aside, -1.0)));
    return min(length(normal.xy) / max(facing, 1e-6), k_max_slope);
}

// Converts a difference of depths, of which the nearest is given, into a share of the picture's height there.
float heights_per_depth(float nearest) {
    const float per_unit = 0.5 * abs(frame.clip_scale.y) * frame.guard;
    return per_unit / (frame.clip_w.x == 0.0 ? abs(frame.clip_z.x) : max(nearest, 1e-30));
}

void main() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const ivec2 low = ivec2(sobel.low_x, sobel.low_y);
    const ivec2 high = ivec2(sobel.high_x, sobel.high_y);
    const vec4 center = texelFetch(shapes, pixel, 0);
    const bool has_shape = is_shape(center);
    float nearest = center.w;
    vec4 across = vec4(0.0);
    vec4 down = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) continue;
            const ivec2 place = clamp(pixel + sobel.reach * ivec2(x, y), low, high);
            vec4 shape = texelFetch(shapes, place, 0);
            nearest = max(nearest, shape.w);
            // A step to nothing is one of depth.
            if (!has_shape || !is_shape(shape)) shape.xyz = center.xyz;
            across += float(x * (2 - abs(y))) * shape;
            down += float(y * (2 - abs(x))) * shape;
        }
    across *= 0.25;
    down *= 0.25;
    const float normal_step = sqrt(dot(across.xyz, across.xyz) + dot(down.xyz, down.xyz));
    const float depth_step = length(vec2(across.w, down.w)) * heights_per_depth(nearest);
    const float slope = has_shape ? slope_of(center.xyz, gl_FragCoord.xy) : 0.0;
    const float explained = slope * 2.0 * float(sobel.reach) / frame.extent.y;
    if (depth_step - explained < sobel.depth_step && normal_step < sobel.normal_step) discard;
    coverage = vec4(0.0, 0.0, 0.0, 1.0);
}
