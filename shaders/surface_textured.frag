#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shading.glsl"
#include "surface_texture.glsl"

// Surfaces in the colors of the mesh, with a texture.

layout(location = 3) centroid in vec3 surface_color;
layout(location = 0) out vec4 color;

void main() { color = shaded_surface(surface_color * texture_color()); }
