#version 460
#extension GL_GOOGLE_include_directive : require

// A corner's number; the geometry stage that follows reads its place.

layout(location = 0) flat out uint corner;

void main() { corner = uint(gl_VertexIndex); }
