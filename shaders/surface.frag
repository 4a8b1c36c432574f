#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shading.glsl"

// Surfaces in the color of their instance.

layout(location = 0) out vec4 color;

void main() { color = shaded_surface(instance.color); }
