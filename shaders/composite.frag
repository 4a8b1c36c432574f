#version 460
#extension GL_EXT_scalar_block_layout : require

// The final picture: ink over surfaces, with the surfaces' alpha as line coverage; or a layer of premultiplied
// color, over a background or with its opacity, then premultiplied or straight. Averages k_scale x k_scale samples per
// pixel in linear light. Then encodes as sRGB if the image format does not.

layout(set = 0, binding = 0) uniform sampler2D surfaces;

layout(push_constant, scalar) uniform Constants {
    vec3 under_or_ink;  // Linear: the ink, or the background of a layer.
    ivec2 corner;       // Of the picture in the target.
};

// Constants of the pipeline, because a dynamic value would cost time per pixel.
layout(constant_id = 0) const int k_scale = 1;
layout(constant_id = 1) const bool k_encodes_srgb = true;
layout(constant_id = 2) const bool k_is_layer = false;
layout(constant_id = 3) const bool k_is_opaque = true;
layout(constant_id = 4) const bool k_is_straight = false;  // Only of a layer that is not opaque.

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

// Formats that store encoded values store 0 to 1; of others the format itself is the limit.
vec3 encoded(vec3 linear) {
    return k_encodes_srgb ? srgb_from_linear(clamp(linear, 0.0, 1.0)) : linear;
}

void main() {
    const ivec2 first = (ivec2(gl_FragCoord.xy) - corner) * k_scale;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < k_scale; ++y)
        for (int x = 0; x < k_scale; ++x) {
            const vec4 surface = texelFetch(surfaces, first + ivec2(x, y), 0);
            if (k_is_layer) sum += surface;
            else sum.rgb += mix(surface.rgb, under_or_ink, surface.a);
        }
    const vec4 mean = sum / float(k_scale * k_scale);
    if (k_is_layer && !k_is_opaque) {
        // Encoded values are of the color itself; their product with alpha is stored.
        const float alpha = clamp(mean.a, 0.0, 1.0);
        const vec3 own = encoded(mean.rgb / max(alpha, 1e-6));
        // A pixel whose alpha may be stored as 0 has none, and no color.
        if (k_is_straight) color = alpha < 0.6 / 255.0 ? vec4(0.0) : vec4(own, alpha);
        else color = vec4(k_encodes_srgb ? own * alpha : mean.rgb, alpha);
    } else {
        const vec3 whole = k_is_layer ? mean.rgb + (1.0 - mean.a) * under_or_ink : mean.rgb;
        color = vec4(encoded(whole), 1.0);
    }
}
