#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"
#include "shadow_emission.h"

// The light cap (instance 0) and the dark cap (instance 1) of each face whose bit is draw.choice; other
// faces collapse to a point. Faces that the light sees from behind are caps turned round; they are
// drawn in their own order, and the pass swaps the stencil's faces instead.
//
// A light cap must have bitwise the depth of the surface it lies on, so this stage does what
// surface.vert does and no geometry stage follows: lavapipe transforms the vertices that leave one with
// other roundings.

precise gl_Position;

void main() {
    const uint face = gl_VertexIndex / 3u;
    if ((light.face_words.at[face / 32u] >> (face % 32u) & 1u) != draw.choice) {
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    const VolumeCorner corner = cap_corner(instance.triangles.at[face],
                                           gl_InstanceIndex == 1, gl_VertexIndex % 3u);
    const vec3 position = instance.positions.at[corner.vertex];
    if (corner.is_far)
        gl_Position = clip_from_extruded(position);
    else
        gl_Position = clip_from_object(position);
}
