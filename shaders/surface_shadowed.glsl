#ifndef RIMLINE_SHADERS_SURFACE_SHADOWED_GLSL
#define RIMLINE_SHADERS_SURFACE_SHADOWED_GLSL

// Surfaces in the only light of a frame, and beside them what they show in its shadow, which is drawn later
// (shadow_color.frag).

#include "surface_shading.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 shadow_color;

void write_surface(vec3 lit) {
    const Shading shading = shading_of(lit);
    color = shading.shade + shading.light;
    shadow_color = shading.shade;
}

#endif
