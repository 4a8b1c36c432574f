#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// A widened back face: a surface in the color of lines. draw.choice is 1 where alpha is opacity.

layout(location = 0) out vec4 color;

void main() { color = vec4(instance.ink, float(draw.choice)); }
