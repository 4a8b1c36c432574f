#version 460
#extension GL_GOOGLE_include_directive : require
#include "silhouette_job.h"
#include "round_to_even.glsl"
#include "face_bit.glsl"
#include "moving_face.glsl"

// Step 1 of 4: computes face bits from planes or corners, and their changes.

layout(local_size_x = RIMLINE_GROUP_WORDS) in;

shared uint words_changed;
shared uint faces_flipped;

bool is_front_face(uint face) {
    if (job.data.from_planes != 0u) return is_front(job.data.planes.at[face], point);
    const TriangleRecord t = job.data.triangles.at[face];
    return is_front(job.data.positions.at[t.v0], job.data.positions.at[t.v1],
                    job.data.positions.at[t.v2], point);
}

void main() {
    const uint group = group_index();
    if (group >= job.data.face_group_count) return;
    if (gl_LocalInvocationIndex == 0u) {
        words_changed = 0u;
        faces_flipped = 0u;
    }
    barrier();
    const uint face_count = job.data.face_count;
    const uint word = group * RIMLINE_GROUP_WORDS + gl_LocalInvocationIndex;
    if (word * 32u < face_count) {
        uint bits = 0u;
        const uint count = min(32u, face_count - word * 32u);
        for (uint i = 0u; i < count; ++i)
            if (is_front_face(word * 32u + i)) bits |= 1u << i;
        const uint changes = job.data.face_words.at[word] ^ bits;
        job.data.face_words.at[word] = bits;
        job.data.face_changes.at[word] = changes;
        if (changes != 0u) {
            atomicAdd(words_changed, 1u);
            atomicAdd(faces_flipped, uint(bitCount(changes)));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        job.data.face_tallies.at[group] = FaceTally(words_changed, faces_flipped);
}
