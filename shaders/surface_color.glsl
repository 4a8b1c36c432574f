#ifndef RIMLINE_SHADERS_SURFACE_COLOR_GLSL
#define RIMLINE_SHADERS_SURFACE_COLOR_GLSL

// The color of a corner in the colors of its mesh (silhouette/mesh/face_materials.h), without its texture.

#include "draw.glsl"

uint unpainted(uint number) {
    return instance.face_materials.at[number / 3u] == k_no_material ? RIMLINE_UNPAINTED : 0u;
}

vec3 color_of_corner(uint number) {
    const uint material = instance.face_materials.at[number / 3u];
    if (material == k_no_material) return instance.color;
    const vec3 base = instance.materials.at[material];
    return instance.has_corner_colors != 0u ? base * instance.corner_colors.at[number] : base;
}

#endif
