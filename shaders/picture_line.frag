#version 460
#extension GL_GOOGLE_include_directive : require
#include "line_coverage.glsl"

// The ink of a capsule whose visibility is known, in alpha. Blending keeps the maximum, as for line.frag.

layout(location = 0) flat in vec4 ends;
layout(location = 1) flat in vec3 pattern;
layout(location = 0) out vec4 coverage;

void main() {
    const float t = share_along(ends, gl_FragCoord.xy);
    const vec2 spine = ends.xy + t * (ends.zw - ends.xy);
    const float covered = covered_across(ends, distance(gl_FragCoord.xy, spine));
    if (covered == 0.0) discard;
    coverage = vec4(0.0, 0.0, 0.0, covered * pattern.z * dash_at(mix(pattern.x, pattern.y, t)));
}
