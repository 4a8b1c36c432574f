#version 460
#extension GL_GOOGLE_include_directive : require
#include "visible_ratio.glsl"

// A corner of a face. The index buffer gives its vertex number.

precise gl_Position;

void main() { gl_Position = clip_from_eye(eye_from_vertex(gl_VertexIndex)); }
