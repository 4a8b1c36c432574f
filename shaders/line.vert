#version 460
#extension GL_GOOGLE_include_directive : require
#include "capsule.glsl"

// The same capsules without a geometry stage: one instance of a four-vertex strip per edge. The strip
// of an edge that is not drawn has no area (Card and Mitchell, Non-Photorealistic Rendering with Pixel
// and Vertex Shaders, 2002, who store every edge as such a quad).

RIMLINE_CAPSULE_VARYINGS(out)

void main() {
    LineEdge edge;
    Capsule capsule;
    if (!read_line_edge(uint(gl_InstanceIndex), edge) || !make_capsule(edge, capsule)) {
        ends = vec4(0.0);
        depths_out = vec4(0.0);
        pattern = vec3(0.0);
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    ends = capsule.ends;
    depths_out = vec4(capsule.depths, capsule.outwards);
    pattern = vec3(capsule.dashes, capsule.two_sided);
    gl_Position = capsule_corner(capsule.ends, uint(gl_VertexIndex));
}
