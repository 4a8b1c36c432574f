#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_corner.glsl"

// Surfaces in one color.

void main() { write_corner(gl_VertexIndex); }
