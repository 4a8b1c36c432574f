#version 460
#extension GL_GOOGLE_include_directive : require
#include "paper_grid.glsl"

// Lines of one color, and under them the paper's grid, to be blended over the surfaces by alpha.

layout(set = 0, binding = 0) uniform sampler2D lines;

layout(push_constant) uniform Constants {
    vec4 ink;   // Linear; alpha is the strength of hidden lines.
    vec4 grid;  // Linear; alpha is the strength of every fifth line.
    int scale;
};

layout(location = 0) out vec4 color;

void main() {
    const ivec2 at = ivec2(gl_FragCoord.xy);
    const float ruled = grid_at(at / scale, textureSize(lines, 0) / scale, grid.a);
    const vec2 line = texelFetch(lines, at, 0).rg;
    const float covered = max(line.r, line.g * ink.a);
    const float alpha = 1.0 - (1.0 - ruled) * (1.0 - covered);
    if (alpha == 0.0) discard;
    color = vec4((grid.rgb * (ruled * (1.0 - covered)) + ink.rgb * covered) / alpha, alpha);
}
