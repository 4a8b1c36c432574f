#version 460
#extension GL_GOOGLE_include_directive : require
#include "capsule.glsl"

// Finds silhouettes without a list of edges: tests every face with its three neighbors in every
// frame. A front face makes a capsule for each edge whose neighbor is a back face. Sides are
// computed from positions. They can differ from the tracker's face bits if the viewpoint is within
// rounding error of a plane.

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 12) out;

layout(location = 0) flat in uint corner[];
RIMLINE_CAPSULE_VARYINGS(out)

bool is_front_triangle(uint a, uint b, uint c) {
    const vec3 origin = instance.positions.at[a];
    const vec3 across = cross(instance.positions.at[b] - origin,
                              instance.positions.at[c] - origin);
    const vec4 viewpoint = instance.viewpoint;
    return dot(across, viewpoint.xyz - viewpoint.w * origin) > 0.0;
}

void main() {
    // Corners 0, 2, 4 are the face's. Corners 1, 3, 5 are the neighbors' across the edge before
    // them.
    if (!is_front_triangle(corner[0], corner[2], corner[4])) return;
    for (int side = 0; side < 3; ++side) {
        const uint a = corner[2 * side];
        const uint b = corner[(2 * side + 2) % 6];
        const uint own = corner[(2 * side + 4) % 6];
        const uint across = corner[2 * side + 1];
        // An edge without a regular neighbor is drawn elsewhere.
        if (across == a || is_front_triangle(b, a, across)) continue;
        Capsule capsule;
        if (!make_capsule(LineEdge(a, b, own, across), capsule)) continue;
        for (uint i = 0u; i < 4u; ++i) {
            ends = capsule.ends;
            depths_out = vec4(capsule.depths, capsule.outwards);
            pattern = vec3(capsule.dashes, capsule.two_sided);
            gl_Position = capsule_corner(capsule.ends, i);
            EmitVertex();
        }
        EndPrimitive();
    }
}
