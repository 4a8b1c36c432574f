#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "hatch.glsl"

// Surfaces in the chosen style, a pipeline each: a CPU that stands in for a GPU takes every branch that is
// not decided when the shader is compiled. They are what shadow leaves of a surface, or what the light adds
// where the stencil lets it through, or both in one where a single light casts no shadows; all lights
// together add up to the fully lit surface. For light, draw.choice is 1 or 2: with 1 the face's bit speaks
// too where the light grazes the face (surface.vert), 2 is for what casts no shadow.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint grazed_side;
layout(location = 0) out vec4 color;

layout(constant_id = 0) const uint k_style = RIMLINE_STYLE_INK;
layout(constant_id = 1) const bool k_has_shade = true;
layout(constant_id = 2) const bool k_has_light = false;
layout(constant_id = 3) const bool k_fades = false;  // The instance's fade_radius is over 0.

// How much of the light a style shows at this cosine. It begins above zero, so that the facets of a
// shadow's own edge lie in what is dark already.
float tone(float cosine) {
    if (k_style == RIMLINE_STYLE_MASK) return 1.0;
    if (k_style == RIMLINE_STYLE_INK)
        return 0.86 * smoothstep(0.14, 0.17, cosine) + 0.14 * smoothstep(0.34, 0.40, cosine);
    if (k_style == RIMLINE_STYLE_BLUEPRINT || k_style == RIMLINE_STYLE_HATCH)
        return clamp((cosine - 0.14) / 0.6, 0.0, 1.0);
    return 0.55 * smoothstep(0.14, 0.17, cosine) + 0.45 * smoothstep(0.52, 0.56, cosine);
}

// The surface where a share `amount` of the light arrives.
vec3 shown(float amount, vec3 facing_normal) {
    const vec3 lit = instance.color;
    const vec3 shade = frame.shade;
    if (k_style != RIMLINE_STYLE_HATCH) return lit * mix(shade, vec3(1.0), amount);
    const float density = (1.0 - dot(shade, vec3(1.0 / 3.0))) * (1.0 - amount);
    return mix(lit, instance.ink, hatch_ink(position, facing_normal, density));
}

void main() {
    vec3 n = normalize(normal);
    // Sheets are lit on the side that is seen.
    if (!gl_FrontFacing) n = -n;
    const vec3 shaded = shown(0.0, n);
    color = vec4(k_has_shade ? shaded : vec3(0.0), 0.0);  // Lines cover nothing yet.
    if (k_has_light) {
        const bool reached = grazed_side == 0u || (grazed_side == 1u) == gl_FrontFacing;
        const vec4 light_point = light.point;
        const vec3 to_light = normalize(light_point.xyz - light_point.w * position);
        float amount = reached ? tone(dot(n, to_light)) : 0.0;
        // What only catches shadows is paper: strokes all over it would say nothing.
        if (k_style == RIMLINE_STYLE_HATCH && draw.choice == 2u)
            amount = smoothstep(0.14, 0.17, dot(n, to_light));
        color.rgb += (shown(amount, n) - shaded) * light.color;
    }
    if (k_fades) {
        const float away = distance(position, instance.fade_center);
        const float fade = smoothstep(0.45, 1.0, away / instance.fade_radius);
        color.rgb = mix(color.rgb, k_has_shade ? frame.background : vec3(0.0), fade);
    }
}
