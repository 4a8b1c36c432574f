#ifndef RIMLINE_SHADERS_MOVING_FACE_GLSL
#define RIMLINE_SHADERS_MOVING_FACE_GLSL

// The face bit of silhouette/mesh/moving_face.h, the same expression in the same order, without
// contraction. The rules of face_bit.glsl apply, too.

vec3 snapped(vec3 v, float smallest) { return mix(v, vec3(0.0), lessThan(abs(v), vec3(smallest))); }

// Multiplies by the power of two that brings the largest component into [1, 2).
vec3 scaled(vec3 v) {
    const float max_component = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (max_component == 0.0) return v;
    const uint exponent = floatBitsToUint(max_component) >> 23;
    precise vec3 result = v * uintBitsToFloat((254u - exponent) << 23);
    return snapped(result, 9.094947017729282e-13);  // 2^-40
}

// The rounding error of `product`: a * b - product. Splits each factor into two parts of at most 12
// bits.
vec3 product_error(vec3 a, vec3 b, vec3 product) {
    precise vec3 a_wide = a * 4097.0;
    precise vec3 a_high = a_wide - (a_wide - a);
    precise vec3 a_low = a - a_high;
    precise vec3 b_wide = b * 4097.0;
    precise vec3 b_high = b_wide - (b_wide - b);
    precise vec3 b_low = b - b_high;
    precise vec3 error =
        a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
    return error;
}

vec3 accurate_cross(vec3 a, vec3 b) {
    precise vec3 left = a.yzx * b.zxy;
    precise vec3 right = a.zxy * b.yzx;
    precise vec3 result = (left - right) +
        (product_error(a.yzx, b.zxy, left) - product_error(a.zxy, b.yzx, right));
    return result;
}

// p is (p, 1) or (v, 0).
bool is_front(vec3 v0, vec3 v1, vec3 v2, vec4 p) {
    const float smallest = 7.888609052210118e-31;  // 2^-100
    v0 = snapped(v0, smallest);
    precise vec3 along = snapped(v1, smallest) - v0;
    precise vec3 across = snapped(v2, smallest) - v0;
    precise vec3 away = p.xyz - v0 * p.w;
    const vec3 n = scaled(accurate_cross(scaled(along), scaled(across)));
    const vec3 q = scaled(away);
    precise float side = (n.x * q.x + n.y * q.y) + n.z * q.z;
    return side > 0.0;
}

#endif
