#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shading.glsl"

// Surfaces in the colors of the mesh, with a texture.

layout(set = 1, binding = 0) uniform sampler2D surface_texture;

layout(location = 3) in vec3 surface_color;
layout(location = 4) in vec2 uv;
layout(location = 0) out vec4 color;

void main() { color = shaded_surface(surface_color * texture(surface_texture, uv).rgb); }
