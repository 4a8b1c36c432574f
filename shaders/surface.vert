#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// A mesh's triangles, pulled: three vertices a face, each with its own corner's normal.

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;

precise gl_Position;

void main() {
    const uint face = gl_VertexIndex / 3u;
    const uint corner = gl_VertexIndex % 3u;
    const TriangleRecord triangle = draw.instance.data.triangles.at[face];
    const uint vertex = corner == 0u ? triangle.v0 : corner == 1u ? triangle.v1 : triangle.v2;
    position = draw.instance.data.positions.at[vertex];
    normal = draw.instance.data.corner_normals.at[gl_VertexIndex];
    gl_Position = clip_from_object(draw.frame, draw.instance, position);
}
