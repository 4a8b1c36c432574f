#ifndef RIMLINE_SHADERS_FACE_BIT_GLSL
#define RIMLINE_SHADERS_FACE_BIT_GLSL

// The face bit of silhouette/mesh/plane.h, the same expression in the same order, without contraction.
// It is exact only in compute stages, in modules that include round_to_even.glsl, because vertex and
// geometry stages may flush subnormals. Comparators that test faces in those stages (line_edge.glsl)
// can be wrong for such a face.

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
