#ifndef RIMLINE_SHADERS_FACE_BIT_GLSL
#define RIMLINE_SHADERS_FACE_BIT_GLSL

// The face bit of silhouette/mesh/plane.h, the same expression in the same order, without contraction.
// Use it only in compute stages, in modules that declare rounding to nearest even (below), because
// vertex and geometry stages may flush subnormals. Comparators that test faces in those stages
// (line_edge.glsl) can be wrong for such a face.

#extension GL_EXT_spirv_intrinsics : require

// RoundingModeRTE for 32-bit floats.
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4467], 4462, 32);

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
