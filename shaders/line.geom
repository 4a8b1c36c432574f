#version 460
#extension GL_GOOGLE_include_directive : require
#include "capsule.glsl"

// Expands one point per edge to the edge's capsule. draw.choice selects the list of edges.

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

RIMLINE_CAPSULE_VARYINGS(out)

void main() {
    LineEdge edge;
    Capsule capsule;
    if (!read_line_edge(uint(gl_PrimitiveIDIn), edge) || !make_capsule(edge, capsule)) return;
    for (uint corner = 0u; corner < 4u; ++corner) {
        ends = capsule.ends;
        depths_out = vec4(capsule.depths, capsule.outwards);
        pattern = vec3(capsule.dashes, capsule.two_sided);
        gl_Position = capsule_corner(capsule.ends, corner);
        EmitVertex();
    }
    EndPrimitive();
}
