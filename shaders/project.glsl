#ifndef RIMLINE_SHADERS_PROJECT_GLSL
#define RIMLINE_SHADERS_PROJECT_GLSL

// Transforms mesh coordinates to clip space, equally for every pass: caps of shadow volumes must have
// exactly the same depth as their surface. Everything is `precise`. Matrix products are not used,
// because a driver may choose their order of summation.

#include "draw.glsl"

vec4 clip_from_eye(vec3 eye, float w) {
    precise vec4 clip;
    clip.z = frame.clip_z.x * eye.z + frame.clip_z.y * w;
    clip.w = frame.clip_w.x * eye.z + frame.clip_w.y * w;
    clip.xy = frame.clip_scale * eye.xy + frame.clip_shift * clip.w;
    return clip;
}

// Rotates a vector from the camera, or a direction, into the camera's axes.
vec3 eye_from_object(vec3 v) {
    precise vec3 eye = instance.eye_from_object[0] * v.x + instance.eye_from_object[1] * v.y +
                       instance.eye_from_object[2] * v.z;
    return eye;
}

vec4 clip_from_object(vec3 position) {
    precise vec3 from_camera = position - instance.camera;
    return clip_from_eye(eye_from_object(from_camera), 1.0);
}

// The end of the ray from the light through `position` (LightData.extrusion): the light itself with its signs turned,
// where all rays end in it, past infinity; at infinity, (position * w - light, 0); or, for views that do not contain
// infinity, behind all surfaces.
vec4 clip_from_extruded(vec3 position) {
    const vec4 from = light.point;
    const float extrusion = light.extrusion;
    if (extrusion == RIMLINE_EXTRUDED_TO_ONE_POINT) {
        precise vec3 past = instance.camera * from.w - from.xyz;
        return clip_from_eye(eye_from_object(past), -from.w);
    }
    precise vec3 away = position * from.w - from.xyz;
    if (extrusion == 0.0) return clip_from_eye(eye_from_object(away), 0.0);
    precise vec3 from_camera = (position - instance.camera) + away * extrusion;
    return clip_from_eye(eye_from_object(from_camera), 1.0);
}

// Whether all rays of the light end in one point, so that volumes have no dark cap.
bool ends_in_one_point() {
    return light.extrusion == RIMLINE_EXTRUDED_TO_ONE_POINT;
}

#endif
