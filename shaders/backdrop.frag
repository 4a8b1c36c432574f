#version 460
#extension GL_GOOGLE_include_directive : require
#include "backdrop.glsl"

// A backdrop with one sample a pixel.

layout(set = 0, binding = 0) uniform sampler2D backdrop;

void main() { write_backdrop(texelFetch(backdrop, ivec2(gl_FragCoord.xy) + corner, 0).r); }
