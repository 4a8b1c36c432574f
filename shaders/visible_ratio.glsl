#ifndef RIMLINE_SHADERS_VISIBLE_RATIO_GLSL
#define RIMLINE_SHADERS_VISIBLE_RATIO_GLSL

// Projection for visible ratios. Surfaces and lines share it, so that a line's ends have exactly the
// same depth as the corners.

#include "layout.h"

layout(push_constant, scalar) uniform Constants { RatioConstants view; };

// The position of a vertex relative to the camera, in its axes.
vec3 eye_from_vertex(uint vertex) {
    precise vec3 from_camera = view.positions.at[vertex] - view.camera;
    precise vec3 eye = view.eye_from_object[0] * from_camera.x + view.eye_from_object[1] * from_camera.y +
                       view.eye_from_object[2] * from_camera.z;
    return eye;
}

vec4 clip_from_eye(vec3 eye) {
    precise vec4 clip = vec4(view.clip_scale * eye.xy, view.near_distance, -eye.z);
    return clip;
}

#endif
