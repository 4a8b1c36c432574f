#version 460
#extension GL_GOOGLE_include_directive : require

// The finished picture: ink over surfaces, averaged from `scale` x `scale` samples a pixel in linear
// light, then encoded as sRGB.

layout(set = 0, binding = 0) uniform sampler2D surfaces;
layout(set = 0, binding = 1) uniform sampler2D lines;

layout(push_constant) uniform Constants {
    vec4 ink;      // Linear; alpha is the strength of hidden lines.
    int scale;
};

layout(location = 0) out vec4 color;

vec3 srgb_from_linear(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
    const ivec2 first = ivec2(gl_FragCoord.xy) * scale;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < scale; ++y)
        for (int x = 0; x < scale; ++x) {
            const ivec2 at = first + ivec2(x, y);
            const vec2 line = texelFetch(lines, at, 0).rg;
            const float covered = max(line.r, line.g * ink.a);
            sum += mix(texelFetch(surfaces, at, 0).rgb, ink.rgb, covered);
        }
    color = vec4(srgb_from_linear(clamp(sum / float(scale * scale), 0.0, 1.0)), 1.0);
}
