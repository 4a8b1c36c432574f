#version 460
#extension GL_GOOGLE_include_directive : require
#include "backdrop.glsl"

// One sample of a backdrop with several samples a pixel.

layout(set = 0, binding = 0) uniform sampler2DMS backdrop;

layout(constant_id = 0) const int k_sample = 0;

void main() { write_backdrop(texelFetch(backdrop, ivec2(gl_FragCoord.xy) + corner, k_sample).r); }
