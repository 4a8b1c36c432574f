#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shadowed.glsl"
#include "surface_texture.glsl"

// As surface_textured.frag, and in shadow.

layout(location = 3) centroid in vec3 surface_color;

void main() { write_surface(surface_color * texture_color()); }
