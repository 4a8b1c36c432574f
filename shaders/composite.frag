#version 460
#extension GL_GOOGLE_include_directive : require
#include "paper_grid.glsl"

// The finished picture: ink over the paper's grid over surfaces, averaged from `scale` x `scale` samples
// a pixel in linear light, then encoded as sRGB where the image does not do so by itself.

layout(set = 0, binding = 0) uniform sampler2D surfaces;
layout(set = 0, binding = 1) uniform sampler2D lines;

layout(push_constant) uniform Constants {
    vec4 ink;      // Linear; alpha is the strength of hidden lines.
    vec4 grid;     // Linear; alpha is the strength of every fifth line.
    int scale;
    uint encodes_srgb;
};

layout(location = 0) out vec4 color;

vec3 srgb_from_linear(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
    const float ruled =
        grid_at(ivec2(gl_FragCoord.xy), textureSize(surfaces, 0) / scale, grid.a);
    const ivec2 first = ivec2(gl_FragCoord.xy) * scale;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < scale; ++y)
        for (int x = 0; x < scale; ++x) {
            const ivec2 at = first + ivec2(x, y);
            const vec2 line = texelFetch(lines, at, 0).rg;
            const float covered = max(line.r, line.g * ink.a);
            const vec3 paper = mix(texelFetch(surfaces, at, 0).rgb, grid.rgb, ruled);
            sum += mix(paper, ink.rgb, covered);
        }
    const vec3 linear = clamp(sum / float(scale * scale), 0.0, 1.0);
    color = vec4(encodes_srgb != 0 ? srgb_from_linear(linear) : linear, 1.0);
}
