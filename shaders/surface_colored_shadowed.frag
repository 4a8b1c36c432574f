#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shadowed.glsl"

// As surface_colored.frag, and in shadow.

layout(location = 3) centroid in vec3 surface_color;

void main() { write_surface(surface_color); }
