#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "project.glsl"

// The sides of shadow volumes: an edge extruded away from the light, as often and in the direction that
// its faces' bits say (the signed multiplicity of Kim, Kim and Turk 2008). draw.choice is 0 for the
// silhouette slots, where the two faces of a regular edge differ and count twice, and 1 for the loose
// list, one record a face.

layout(points) in;
layout(triangle_strip, max_vertices = 8) out;

uint face_bit(uint face) { return draw.light.data.face_words.at[face / 32u] >> (face % 32u) & 1u; }

void main() {
    EdgeRecord edge;
    int times = 1;
    if (draw.choice == 0u) {
        edge = draw.instance.data.edges.at[draw.light.data.slots.at[gl_PrimitiveIDIn]];
        if (edge.f1 == k_no_face) return;
        times = 2;
    } else {
        edge = draw.instance.data.loose_edges.at[gl_PrimitiveIDIn];
    }
    // The light sees the face on the left of from -> to in front; the side faces away from it.
    const bool forward = face_bit(edge.f0) == 1u;
    const vec3 from = draw.instance.data.positions.at[forward ? edge.v0 : edge.v1];
    const vec3 to = draw.instance.data.positions.at[forward ? edge.v1 : edge.v0];
    const vec4 near_from = clip_from_object(draw.frame, draw.instance, from);
    const vec4 near_to = clip_from_object(draw.frame, draw.instance, to);
    const vec4 far_from = clip_from_extruded(draw.frame, draw.instance, draw.light, from);
    const vec4 far_to = clip_from_extruded(draw.frame, draw.instance, draw.light, to);
    const bool pointed = ends_in_one_point(draw.light);
    for (int i = 0; i < times; ++i) {
        gl_Position = near_to;
        EmitVertex();
        gl_Position = near_from;
        EmitVertex();
        gl_Position = far_to;
        EmitVertex();
        if (!pointed) {
            gl_Position = far_from;
            EmitVertex();
        }
        EndPrimitive();
    }
}
