#version 460
#extension GL_GOOGLE_include_directive : require
#include "deform_job.h"

// A wave through a mesh: computes current vertex positions from rest positions.

layout(local_size_x = RIMLINE_DEFORM_GROUP) in;

const float k_turn_rad = 6.283185307179586;

void main() {
    const uint vertex = invocation_index();
    if (vertex >= job.data.vertex_count) return;
    const vec3 rest = job.data.rest.at[vertex];
    const vec3 from_center = rest - wave.center;
    // In [-0.5, 0.5): the precision of sin() is specified in [-pi, pi] only.
    const float turns = fract(dot(wave.per_length, from_center) - wave.turns + 0.5) - 0.5;
    job.data.positions.at[vertex] = rest + wave.reach * sin(k_turn_rad * turns);
}
