#version 460
#extension GL_GOOGLE_include_directive : require
#include "silhouette_job.h"

// Step 2 of 4: finds the edges on the silhouette, by the rules of silhouette/mesh/face_bits.h, and
// the edges that joined or left it.

layout(local_size_x = RIMLINE_GROUP_WORDS) in;

shared uint on_silhouette;
shared uint on_regular;
shared uint added;
shared uint removed;

uint face_bit(uint face) { return job.data.face_words.at[face / 32u] >> (face % 32u) & 1u; }

bool is_on_silhouette(uint edge) {
    if (edge < job.data.two_face_end) {
        const EdgeFaces faces = job.data.edge_faces.at[edge];
        const bool differ = face_bit(faces.f0) != face_bit(faces.f1);
        return differ != (edge >= job.data.regular_end);
    }
    const uint fan = edge - job.data.two_face_end;
    const uint begin = job.data.fan_begin.at[fan];
    const uint end = job.data.fan_begin.at[fan + 1u];
    const uint first = face_bit(job.data.fan_faces.at[begin]);
    for (uint i = begin + 1u; i < end; ++i)
        if (face_bit(job.data.fan_faces.at[i]) != first) return true;
    return false;
}

// A mask of a word's bits for edges before `end`.
uint mask_before(uint word, uint end) {
    if (end <= word * 32u) return 0u;
    const uint count = end - word * 32u;
    return count >= 32u ? 0xffffffffu : (1u << count) - 1u;
}

void main() {
    const uint group = group_index();
    if (group >= job.data.edge_group_count) return;
    if (gl_LocalInvocationIndex == 0u) {
        on_silhouette = 0u;
        on_regular = 0u;
        added = 0u;
        removed = 0u;
    }
    barrier();
    const uint edge_count = job.data.edge_count;
    const uint word = group * RIMLINE_GROUP_WORDS + gl_LocalInvocationIndex;
    if (word * 32u < edge_count) {
        uint bits = 0u;
        const uint count = min(32u, edge_count - word * 32u);
        for (uint i = 0u; i < count; ++i)
            if (is_on_silhouette(word * 32u + i)) bits |= 1u << i;
        const uint before = job.data.edge_words.at[word];
        job.data.edge_words.at[word] = bits;
        job.data.edge_changes.at[word] = before ^ bits;
        if ((bits | before) != 0u) {
            atomicAdd(on_silhouette, uint(bitCount(bits)));
            atomicAdd(on_regular, uint(bitCount(bits & mask_before(word, job.data.regular_end))));
            atomicAdd(added, uint(bitCount(bits & ~before)));
            atomicAdd(removed, uint(bitCount(before & ~bits)));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        job.data.edge_tallies.at[group] = EdgeTally(on_silhouette, on_regular, added, removed);
}
