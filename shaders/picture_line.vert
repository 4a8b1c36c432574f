#version 460
#extension GL_GOOGLE_include_directive : require
#include "capsule.glsl"

// The capsule of a segment whose visibility is known: one instance of a four-vertex strip per segment.

layout(location = 0) flat out vec4 ends;     // Start and end, in pixels.
layout(location = 1) flat out vec3 pattern;  // Dashes at both ends; the strength of the ink.

void main() {
    const LineSegment segment = instance.segments.at[uint(gl_InstanceIndex)];
    ends = segment.ends;
    pattern = vec3(segment.dashes, segment.strength);
    gl_Position = capsule_corner(segment.ends, uint(gl_VertexIndex));
}
