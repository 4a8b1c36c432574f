#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// The vertices of a mesh, drawn with an index buffer, for surfaces without light. It runs once per
// vertex. surface.vert has a normal per corner, so it runs once per corner.

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out uint grazed_side;

precise gl_Position;

void main() {
    position = instance.positions.at[gl_VertexIndex];
    // Unused.
    normal = vec3(0.0);
    grazed_side = 0u;
    gl_Position = clip_from_object(position);
}
