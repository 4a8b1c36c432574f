#ifndef RIMLINE_SHADERS_SHADOW_SIDE_GLSL
#define RIMLINE_SHADERS_SHADOW_SIDE_GLSL

// The sides of shadow volumes, for both stages that draw them. A side is an edge extruded away from
// the light, oriented by its face's bit. It is drawn once for each face that casts it, which gives the
// signed multiplicity of Kim, Kim and Turk 2008. draw.choice is one of RIMLINE_SIDES_.

#include "draw.glsl"
#include "project.glsl"
#include "shadow_emission.h"

struct Side {
    EdgeRecord edge;
    bool is_front;  // The bit of edge.f0.
    bool is_cast;
};

bool shadow_face_bit(uint face) {
    return (light.face_words.at[face / 32u] >> (face % 32u) & 1u) == 1u;
}

Side side_of_record(uint record) {
    const uint list = draw.choice & 3u;
    Side side;
    if (list == RIMLINE_SIDES_SLOTS)
        side.edge = instance.edges.at[light.slots.at[record]];
    else if (list == RIMLINE_SIDES_LOOSE)
        side.edge = instance.loose_edges.at[record];
    else
        side.edge = light.part_sides.at[record];
    side.is_front = shadow_face_bit(side.edge.f0);
    // All regular edges in slots cast. Other records are one for each face.
    side.is_cast = list == RIMLINE_SIDES_SLOTS
                       ? side.edge.f1 != k_no_face
                       : side.is_front || (draw.choice & RIMLINE_SIDES_SINGLE) == 0u;
    return side;
}

vec4 clip_of_corner(VolumeCorner corner) {
    const vec3 position = instance.positions.at[corner.vertex];
    if (corner.is_far)
        return clip_from_extruded(position);
    return clip_from_object(position);
}

#endif
