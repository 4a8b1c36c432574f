#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "hatch.glsl"

// Surfaces without a color of their own (SceneInstance::has_surfaces): nothing, or the shadow of one light as
// opacity. With the inputs and constants of surface_shading.glsl.

layout(location = 0) in vec3 position;
layout(location = 1) centroid in vec3 normal;
layout(location = 0) out vec4 color;

layout(constant_id = 0) const uint k_style = RIMLINE_STYLE_INK;
layout(constant_id = 1) const bool k_has_shade = true;
layout(constant_id = 3) const bool k_fades = false;

void main() {
    if (k_has_shade) {
        color = vec4(0.0);
        return;
    }
    const vec3 mean = vec3(1.0 / 3.0);
    const vec3 shade = frame.shade;
    const vec3 share = light.color;
    const float density = 1.0 - dot(shade, mean);
    vec4 shadow = vec4(0.0, 0.0, 0.0, density);
    if (k_style == RIMLINE_STYLE_HATCH) {
        const vec3 n = normalize(gl_FrontFacing ? normal : -normal);
        shadow = vec4(instance.ink, 1.0) * hatch_ink(position, n, density);
    }
    float opacity = dot(share, mean);
    if (k_fades)
        opacity *= 1.0 - smoothstep(0.45, 1.0,
                                    distance(position, instance.fade_center) / instance.fade_radius);
    color = opacity * shadow;
}
