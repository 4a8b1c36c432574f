#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface_shadowed.glsl"

// As surface.frag, and in shadow.

void main() { write_surface(instance.color); }
