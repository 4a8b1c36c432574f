#ifndef RIMLINE_SHADERS_PROJECT_GLSL
#define RIMLINE_SHADERS_PROJECT_GLSL

// From a mesh's own coordinates to clip space, one way for every pass: caps of shadow volumes must have
// bitwise the depth of the surface they lie on. `precise`, and no matrix products, whose order of
// summation a driver may choose.

#include "layout.h"

vec4 clip_from_eye(FrameRef frame, vec3 eye, float w) {
    precise vec4 clip;
    clip.xy = frame.data.clip_scale * eye.xy;
    clip.z = frame.data.clip_z.x * eye.z + frame.data.clip_z.y * w;
    clip.w = frame.data.clip_w.x * eye.z + frame.data.clip_w.y * w;
    return clip;
}

// A vector from the camera, or a direction, in the camera's axes.
vec3 eye_from_object(InstanceRef instance, vec3 v) {
    precise vec3 eye = instance.data.eye_from_object[0] * v.x + instance.data.eye_from_object[1] * v.y +
                       instance.data.eye_from_object[2] * v.z;
    return eye;
}

vec4 clip_from_object(FrameRef frame, InstanceRef instance, vec3 position) {
    precise vec3 from_camera = position - instance.data.camera;
    return clip_from_eye(frame, eye_from_object(instance, from_camera), 1.0);
}

// Where the ray from the light through `position` ends: at infinity, (position * w - light, 0), or
// where infinity is on no screen, so far out that it lies behind everything (LightData.extrusion).
vec4 clip_from_extruded(FrameRef frame, InstanceRef instance, LightRef light, vec3 position) {
    const vec4 from = light.data.light;
    const float extrusion = light.data.extrusion;
    precise vec3 away = position * from.w - from.xyz;
    if (extrusion == 0.0) return clip_from_eye(frame, eye_from_object(instance, away), 0.0);
    const float times = from.w == 0.0 ? extrusion * inversesqrt(dot(away, away)) : extrusion;
    precise vec3 from_camera = (position - instance.data.camera) + away * times;
    return clip_from_eye(frame, eye_from_object(instance, from_camera), 1.0);
}

// Whether all rays of the light end in one point, so that volumes have no dark cap. The vector is read
// whole: of its single component lavapipe 22.3 makes x here, and sides lost a corner where x was 0.
bool ends_in_one_point(LightRef light) {
    const vec4 from = light.data.light;
    return from.w == 0.0 && light.data.extrusion == 0.0;
}

#endif
