#ifndef RIMLINE_SHADERS_FACE_BIT_GLSL
#define RIMLINE_SHADERS_FACE_BIT_GLSL

// The face bit of silhouette/mesh/plane.h, the same expression in the same order, without contraction.
// It is exact only in modules that include round_to_even.glsl: those of compute stages. Where a device rounds in another
// way in vertex and geometry stages, comparators there (line_edge.glsl) can be wrong for a face that the viewer sees
// nearly from its side.

// plane is (n, d); p is (p, 1) or (v, 0).
bool is_front(vec4 plane, vec4 p) {
    precise float x = plane.x * p.x;
    precise float y = plane.y * p.y;
    precise float z = plane.z * p.z;
    precise float xy = x + y;
    precise float side = xy + z;
    precise float distance = p.w * plane.w;
    return side > distance;
}

#endif
