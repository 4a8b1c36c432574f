#version 460
#extension GL_GOOGLE_include_directive : require
#include "overlay_layout.h"

// One corner of a triangle, fetched by its index.

layout(push_constant, scalar) uniform Constants { OverlayConstants overlay; };

layout(location = 0) out vec4 color;
layout(location = 1) out vec2 texture_place;

void main() {
    const OverlayVertex corner = overlay.vertices.at[overlay.indices.at[gl_VertexIndex]];
    color = unpackUnorm4x8(corner.color);
    texture_place = corner.texture;
    gl_Position = vec4((corner.place - overlay.origin) / overlay.unit_size * 2.0 - 1.0, 0.0, 1.0);
}
