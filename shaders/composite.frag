#version 460
#extension GL_GOOGLE_include_directive : require
#include "paper_grid.glsl"

// The finished picture: ink over the paper's grid over surfaces, averaged from k_scale x k_scale samples
// a pixel in linear light, then encoded as sRGB where the image does not do so by itself.

layout(set = 0, binding = 0) uniform sampler2D surfaces;
layout(set = 0, binding = 1) uniform sampler2D lines;

layout(push_constant) uniform Constants {
    vec4 ink;   // Linear; alpha is the strength of hidden lines.
    vec4 grid;  // Linear; alpha is the strength of every fifth line.
};

// What is the same for many frames: a pipeline each, for what is not known costs each pixel.
layout(constant_id = 0) const int k_scale = 1;
layout(constant_id = 1) const bool k_encodes_srgb = true;
layout(constant_id = 2) const bool k_has_grid = true;

layout(location = 0) out vec4 color;

// c^(1 / 2.4) is q^(5 / 3) of the fourth root q, here a polynomial: within 1e-5, a 400th of a step of 8 bits,
// and far cheaper than powers where those are not the hardware's.
vec3 srgb_from_linear(vec3 c) {
    const vec3 q = sqrt(sqrt(c));
    const vec3 bright =
        -0.0616297 +
        q * (0.16497400 +
             q * (1.24421400 + q * (-0.55755565 + q * (0.27275224 + q * -0.06275899))));
    return mix(12.92 * c, bright, greaterThan(c, vec3(0.0031308)));
}

void main() {
    float ruled = 0.0;
    if (k_has_grid)
        ruled = grid_at(ivec2(gl_FragCoord.xy), textureSize(surfaces, 0) / k_scale, grid.a);
    const ivec2 first = ivec2(gl_FragCoord.xy) * k_scale;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < k_scale; ++y)
        for (int x = 0; x < k_scale; ++x) {
            const ivec2 at = first + ivec2(x, y);
            const vec2 line = texelFetch(lines, at, 0).rg;
            const float covered = max(line.r, line.g * ink.a);
            vec3 paper = texelFetch(surfaces, at, 0).rgb;
            if (k_has_grid) paper = mix(paper, grid.rgb, ruled);
            sum += mix(paper, ink.rgb, covered);
        }
    const vec3 linear = clamp(sum / float(k_scale * k_scale), 0.0, 1.0);
    color = vec4(k_encodes_srgb ? srgb_from_linear(linear) : linear, 1.0);
}
