#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// Surfaces without a color of their own (SceneInstance::has_surfaces): nothing, or the shadow of one light as
// opacity. With the constants of surface_shading.glsl.

layout(location = 0) in vec3 position;
layout(location = 0) out vec4 color;

layout(constant_id = 1) const bool k_has_shade = true;
layout(constant_id = 3) const bool k_fades = false;

void main() {
    const vec3 mean = vec3(1.0 / 3.0);
    const vec3 shade = frame.shade;
    const vec3 share = light.color;
    float opacity = k_has_shade ? 0.0 : dot(share, mean) * (1.0 - dot(shade, mean));
    if (k_fades)
        opacity *= 1.0 - smoothstep(0.45, 1.0,
                                    distance(position, instance.fade_center) / instance.fade_radius);
    color = vec4(0.0, 0.0, 0.0, opacity);
}
