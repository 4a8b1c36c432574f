#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// Surfaces in the chosen style. draw.choice is 0 for what shadow leaves of them, 1 and 2 for what the
// light adds where the stencil lets it through; all lights together add up to the fully lit surface.
// With 1 the face's bit speaks too where the light grazes the face (surface.vert). 2 is for what casts
// no shadow.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint grazed_side;
layout(location = 0) out vec4 color;

// How much of the light a style shows at this cosine. It begins above zero, so that the facets of a
// shadow's own edge lie in what is dark already.
float tone(uint style, float cosine) {
    if (style == RIMLINE_STYLE_MASK) return 1.0;
    if (style == RIMLINE_STYLE_INK)
        return 0.86 * smoothstep(0.14, 0.17, cosine) + 0.14 * smoothstep(0.34, 0.40, cosine);
    return 0.55 * smoothstep(0.14, 0.17, cosine) + 0.45 * smoothstep(0.52, 0.56, cosine);
}

void main() {
    vec3 lit = draw.instance.data.color;
    vec3 shaded = lit * draw.frame.data.shade;
    if (draw.instance.data.fade_radius > 0.0) {
        const float away = distance(position, draw.instance.data.fade_center);
        const float fade = smoothstep(0.45, 1.0, away / draw.instance.data.fade_radius);
        shaded = mix(shaded, draw.frame.data.background, fade);
        lit = mix(lit, draw.frame.data.background, fade);
    }
    if (draw.choice == 0u) {
        color = vec4(shaded, 1.0);
        return;
    }
    vec3 n = normalize(normal);
    // Sheets are lit on the side that is seen.
    if (!gl_FrontFacing) n = -n;
    const bool reached = grazed_side == 0u || (grazed_side == 1u) == gl_FrontFacing;
    const vec4 light = draw.light.data.light;
    const vec3 to_light = normalize(light.xyz - light.w * position);
    const float amount = reached ? tone(draw.frame.data.style, dot(n, to_light)) : 0.0;
    color = vec4((lit - shaded) * amount * draw.light.data.color, 0.0);
}
