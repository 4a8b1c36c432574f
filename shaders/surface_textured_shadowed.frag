#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shadowed.glsl"

// As surface_textured.frag, and in shadow.

layout(set = 1, binding = 0) uniform sampler2D surface_texture;

layout(location = 3) in vec3 surface_color;
layout(location = 4) in vec2 uv;

void main() { write_surface(surface_color * texture(surface_texture, uv).rgb); }
