#ifndef RIMLINE_SHADERS_SURFACE_SHADING_GLSL
#define RIMLINE_SHADERS_SURFACE_SHADING_GLSL

// Surfaces in one style. Each style is its own pipeline, because a CPU device executes both sides of every
// dynamic branch. The output is the shaded surface (as in shadow), or the light added where the stencil
// test passes, or both at once for a single light, with the surface in shadow as a second output where it casts
// shadows. The sum over all lights is the fully lit surface. A light that fills (Light::fills) gives the surface in
// this light alone, and one of both is kept (SurfaceFilling, engine/passes/draw_list.h). For light, draw.choice is 1
// where the instance casts a shadow: then the face's bit is also used if the light grazes the face
// (surface_corner.glsl).

#include "draw.glsl"
#include "hatch.glsl"

// A triangle may cover samples of a pixel, but not its center. There, values that are not `centroid` are
// extrapolated. The position is so on purpose: strokes of hatching continue across edges of triangles.
layout(location = 0) in vec3 position;
layout(location = 1) centroid in vec3 normal;
layout(location = 2) flat in uint grazed_side;

layout(constant_id = 0) const uint k_style = RIMLINE_STYLE_INK;
layout(constant_id = 1) const bool k_has_shade = true;
layout(constant_id = 2) const bool k_has_light = false;
layout(constant_id = 3) const bool k_fades = false;  // The instance's fade_radius is > 0.
layout(constant_id = 4) const bool k_is_layer = false;  // Alpha is opacity, color premultiplied.
layout(constant_id = 5) const bool k_fills = false;

// The share of the light that a style shows at this cosine. It is 0 up to a positive cosine, so that the
// facets at a shadow boundary are in the dark part already.
float tone(float cosine) {
    if (k_style == RIMLINE_STYLE_MASK) return 1.0;
    if (k_style == RIMLINE_STYLE_INK)
        return 0.86 * smoothstep(0.14, 0.17, cosine) + 0.14 * smoothstep(0.34, 0.40, cosine);
    if (k_style == RIMLINE_STYLE_BLUEPRINT || k_style == RIMLINE_STYLE_HATCH)
        return clamp((cosine - 0.14) / 0.6, 0.0, 1.0);
    return 0.55 * smoothstep(0.14, 0.17, cosine) + 0.45 * smoothstep(0.52, 0.56, cosine);
}

// As line_shade() (silhouette/mesh/material_inks.h).
vec3 stroke_ink(vec3 lit) {
    if (instance.stroke_inks == RIMLINE_STROKES_OWN || (grazed_side & RIMLINE_UNPAINTED) != 0u)
        return instance.ink;
    if (instance.stroke_inks == RIMLINE_STROKES_PALE) return mix(lit, vec3(1.0), 0.5);
    const float luminance = dot(lit, vec3(0.2126, 0.7152, 0.0722));
    return lit * min(0.25, 0.05 / max(luminance, 0.05));
}

// The color of a surface that is `lit` in full light, if a share `amount` of the light arrives.
vec3 shown(vec3 lit, float amount, vec3 facing_normal) {
    const vec3 shade = frame.shade;
    if (k_style != RIMLINE_STYLE_HATCH) return lit * mix(shade, vec3(1.0), amount);
    const float density = (1.0 - dot(shade, vec3(1.0 / 3.0))) * (1.0 - amount);
    return mix(lit, stroke_ink(lit), hatch_ink(position, facing_normal, density));
}

// What the outputs add up to: a surface that is `lit` in full light, in the shadow of all lights, and the light.
struct Shading {
    vec4 shade, light;
};

Shading shading_of(vec3 lit) {
    vec3 n = normalize(normal);
    // Open sheets are lit on the visible side.
    if (!gl_FrontFacing) n = -n;
    const vec3 shaded = shown(lit, 0.0, n);
    // No line coverage yet, if alpha is that.
    vec4 shade = vec4(k_has_shade ? shaded : vec3(0.0), k_is_layer && k_has_shade ? 1.0 : 0.0);
    vec4 added = vec4(0.0);
    if (k_has_light) {
        const uint lit_side = grazed_side & 3u;
        const bool reached = lit_side == 0u || (lit_side == 1u) == gl_FrontFacing;
        const vec4 light_point = light.point;
        const vec3 to_light = normalize(light_point.xyz - light_point.w * position);
        // A surface that fades into the background is the background, with shadows on it.
        const float amount = k_fades ? 1.0 : reached ? tone(dot(n, to_light)) : 0.0;
        if (k_fills) added.rgb = shown(lit, amount * light.color.x, n);
        else added.rgb = (shown(lit, amount, n) - shaded) * light.color;
    }
    if (k_fades) {
        const float away = distance(position, instance.fade_center);
        const float fade = smoothstep(0.45, 1.0, away / instance.fade_radius);
        if (k_is_layer) shade *= 1.0 - fade;
        else shade.rgb = mix(shade.rgb, k_has_shade ? frame.background : vec3(0.0), fade);
        added *= 1.0 - fade;
    }
    return Shading(shade, added);
}

// The output for a surface that is `lit` in full light.
vec4 shaded_surface(vec3 lit) {
    const Shading shading = shading_of(lit);
    return shading.shade + shading.light;
}

#endif
