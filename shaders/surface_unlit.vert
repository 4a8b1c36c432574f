#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// A mesh's vertices, drawn by its triangles' indices, for surfaces on which no light falls: each vertex
// once, where surface.vert, which has a normal for each corner of a face, runs for each of them.

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out uint grazed_side;

precise gl_Position;

void main() {
    position = instance.positions.at[gl_VertexIndex];
    // Nobody reads these.
    normal = vec3(0.0);
    grazed_side = 0u;
    gl_Position = clip_from_object(position);
}
