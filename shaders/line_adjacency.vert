#version 460
#extension GL_GOOGLE_include_directive : require

// Passes a corner's number. The geometry stage reads its position.

layout(location = 0) flat out uint corner;

void main() { corner = uint(gl_VertexIndex); }
