#version 460
#extension GL_GOOGLE_include_directive : require
#include "visible_ratio.glsl"

// A corner of a face, by its vertex number: the index buffer's.

precise gl_Position;

void main() { gl_Position = clip_from_eye(eye_from_vertex(gl_VertexIndex)); }
