#version 460
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"

// The square around a disc, in the disc's plane.

layout(location = 0) out vec2 place;
layout(location = 1) flat out vec3 color;
layout(location = 2) flat out vec4 cuts;  // In the axes of `place`.
layout(location = 3) flat out vec3 rest;  // The third cut, and the depth difference from center to edge.

// The share of a disc's color when it is seen edge-on. The light is at the camera.
const float k_ambient = 0.35;
// A disc is a flat cone: its edge lies behind its center by this share of its radius. If discs overlap,
// the one with the nearest center is visible, so each point has its own cell without z-fighting.
const float k_slope = 0.15;

void main() {
    const SplatRecord splat = cloud.splats.at[gl_InstanceIndex];
    const vec3 towards = towards_camera(splat.position);
    const bool has_normal = dot(splat.normal, splat.normal) > 0.0;
    const vec3 normal = has_normal ? splat.normal : towards;
    const vec3 aside = abs(normal.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    const vec3 u = normalize(cross(normal, aside));
    const vec3 v = cross(normal, u);
    rest.xy = vec2(dot(splat.cuts[2], u), dot(splat.cuts[2], v));
    cuts = vec4(dot(splat.cuts[0], u), dot(splat.cuts[0], v), dot(splat.cuts[1], u),
                dot(splat.cuts[1], v));
    place = corner_of(gl_VertexIndex);
    gl_Position = clip_from_world(splat.position + splat.radius * (place.x * u + place.y * v));
    const vec4 center = clip_from_world(splat.position);
    const vec4 behind = clip_from_world(splat.position - k_slope * splat.radius * towards);
    // Behind the camera there is no depth: the disc is flat.
    const bool has_depths = min(center.w, behind.w) > 0.0;
    rest.z = has_depths ? max(center.z / center.w - behind.z / behind.w, 0.0) : 0.0;
    const vec4 given = unpackUnorm4x8(splat.color);
    const float light = given.a > 0.5 ? 1.0 : mix(k_ambient, 1.0, abs(dot(normal, towards)));
    color = light * linear_from_srgb(given.rgb);
}
