#ifndef RIMLINE_SHADERS_SPLAT_GLSL
#define RIMLINE_SHADERS_SPLAT_GLSL

// Shared code of splats and strokes: the camera, and the two triangles of each.

#include "splat_layout.h"

layout(push_constant, scalar) uniform Constants { SplatConstants cloud; };

vec4 clip_from_world(vec3 position) {
    const vec3 eye = cloud.eye_from_world * (position - cloud.camera);
    const float w = cloud.clip_w.x * eye.z + cloud.clip_w.y;
    return vec4(cloud.clip_scale * eye.xy + cloud.clip_shift * w,
                cloud.clip_z.x * eye.z + cloud.clip_z.y, w);
}

// The unit vector from a position to the camera. For an orthographic camera it is the same everywhere.
vec3 towards_camera(vec3 position) {
    const vec3 back = vec3(cloud.eye_from_world[0].z, cloud.eye_from_world[1].z,
                           cloud.eye_from_world[2].z);
    return cloud.clip_w.x == 0.0 ? back : normalize(cloud.camera - position);
}

// The corners of the square from (-1, -1) to (1, 1), as two triangles.
vec2 corner_of(uint vertex) {
    const uint corner = vertex < 3 ? vertex : vertex - 2;  // 0 1 2, 1 2 3
    return vec2((corner & 1u) != 0 ? 1.0 : -1.0, (corner & 2u) != 0 ? 1.0 : -1.0);
}

vec3 linear_from_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

#endif
