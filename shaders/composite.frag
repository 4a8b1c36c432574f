#version 460

// The final picture: ink over surfaces, with the surfaces' alpha as line coverage. Averages k_scale x k_scale
// samples per pixel in linear light. Then encodes as sRGB if the image format does not.

layout(set = 0, binding = 0) uniform sampler2D surfaces;

layout(push_constant) uniform Constants { vec3 ink; };  // Linear.

// Constants of the pipeline, because a dynamic value would cost time per pixel.
layout(constant_id = 0) const int k_scale = 1;
layout(constant_id = 1) const bool k_encodes_srgb = true;

layout(location = 0) out vec4 color;

// c^(1 / 2.4) = q^(5 / 3) with the fourth root q, approximated by a polynomial. The error is below 1e-5, a
// 400th of an 8-bit step. It is much cheaper than pow() without hardware support.
vec3 srgb_from_linear(vec3 c) {
    const vec3 q = sqrt(sqrt(c));
    const vec3 bright =
        -0.0616297 +
        q * (0.16497400 +
             q * (1.24421400 + q * (-0.55755565 + q * (0.27275224 + q * -0.06275899))));
    return mix(12.92 * c, bright, greaterThan(c, vec3(0.0031308)));
}

void main() {
    const ivec2 first = ivec2(gl_FragCoord.xy) * k_scale;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < k_scale; ++y)
        for (int x = 0; x < k_scale; ++x) {
            const vec4 surface = texelFetch(surfaces, first + ivec2(x, y), 0);
            sum += mix(surface.rgb, ink, surface.a);
        }
    const vec3 linear = clamp(sum / float(k_scale * k_scale), 0.0, 1.0);
    color = vec4(k_encodes_srgb ? srgb_from_linear(linear) : linear, 1.0);
}
