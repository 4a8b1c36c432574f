#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"
#include "shadow_emission.h"

// The light cap (instance 0) and the dark cap (instance 1) of each face whose bit is bit 0 of draw.choice. Other
// faces become a point. The caps of faces that the light sees from behind are reversed. They are drawn
// in their original order, and the pass swaps front and back in the stencil state instead.
//
// A light cap must have exactly the same depth as its surface. So this stage computes like
// surface.vert, and there is no geometry stage: lavapipe transforms vertices after a geometry stage
// with different rounding.

precise gl_Position;

void main() {
    const uint place = gl_VertexIndex / 3u;
    const uint face = (draw.choice & RIMLINE_CAPS_PART) != 0u ? light.part_faces.at[place] : place;
    if ((light.face_words.at[face / 32u] >> (face % 32u) & 1u) != (draw.choice & 1u)) {
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
