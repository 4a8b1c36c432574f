#version 460
#extension GL_GOOGLE_include_directive : require
#include "shadow_side.glsl"

// Sides by geometry shader, one point per record. The corners equal those of shadow_sides.vert.

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

precise gl_Position;

void main() {
    const Side side = side_of_record(gl_PrimitiveIDIn);
    if (!side.is_cast) return;
    for (uint corner = 0u; corner < 3u; ++corner) {
        gl_Position = clip_of_corner(side_corner(side.edge, side.is_front, corner));
        EmitVertex();
    }
    // The second triangle has corners 1, 3 and 2 of the strip, which are corners 3, 4 and 5 of the
    // side.
    if (!ends_in_one_point()) {
        gl_Position = clip_of_corner(side_corner(side.edge, side.is_front, 4u));
        EmitVertex();
    }
    EndPrimitive();
}
