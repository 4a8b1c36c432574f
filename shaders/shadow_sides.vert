#version 460
#extension GL_GOOGLE_include_directive : require
#include "shadow_side.glsl"

// Sides by vertex pulling: six vertices per record, or three if all rays end in one point. Sides and
// caps compute their shared corners in the same stage with the same arithmetic, so every driver gives
// equal results and volumes are watertight to the last bit.

precise gl_Position;

void main() {
    const uint corners = ends_in_one_point() ? 3u : 6u;
    const Side side = side_of_record(gl_VertexIndex / corners);
    if (!side.is_cast) {
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    gl_Position = clip_of_corner(side_corner(side.edge, side.is_front, gl_VertexIndex % corners));
}
