#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

// The shape that a pixel shows: its normal towards the viewer, in the camera's axes, and its depth as a number that
// is linear on the screen where the surface is plane. Zero where there is no outline to find (sobel.frag).

layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 shape;

void main() {
    vec3 n = instance.inverse_scale * (instance.eye_from_object * normalize(normal));
    if (!gl_FrontFacing) n = -n;
    const bool is_orthographic = frame.clip_w.x == 0.0;
    const float depth = is_orthographic ? gl_FragCoord.z : gl_FragCoord.w;
    shape = draw.choice == RIMLINE_SHAPE_HIDING ? vec4(0.0) : vec4(n, depth);
}
