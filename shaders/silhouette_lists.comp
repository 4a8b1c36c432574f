#version 460
#extension GL_GOOGLE_include_directive : require
#include "silhouette_job.h"

// Step 4 of 4: converts bits to lists. Groups of edges come first, then groups of face words.

layout(local_size_x = RIMLINE_GROUP_WORDS) in;

shared uvec3 sums[RIMLINE_GROUP_WORDS];

// The sum over all earlier invocations of the group.
uvec3 sum_before(uvec3 own) {
    const uint lane = gl_LocalInvocationIndex;
    sums[lane] = own;
    barrier();
    for (uint reach = 1u; reach < RIMLINE_GROUP_WORDS; reach *= 2u) {
        const uvec3 other = lane >= reach ? sums[lane - reach] : uvec3(0u);
        barrier();
        sums[lane] += other;
        barrier();
    }
    return sums[lane] - own;
}

void append(EdgeList list, uint place, uint word, uint bits) {
    for (; bits != 0u; bits &= bits - 1u) {
        list.at[place] = word * 32u + uint(findLSB(bits));
        ++place;
    }
}

void write_edges(uint group) {
    const uint word = group * RIMLINE_GROUP_WORDS + gl_LocalInvocationIndex;
    uint bits = 0u;
    uint changes = 0u;
    if (word * 32u < job.data.edge_count) {
        bits = job.data.edge_words.at[word];
        changes = job.data.edge_changes.at[word];
    }
    const uint added = changes & bits;
    const uint removed = changes & ~bits;
    const uvec3 before = sum_before(uvec3(bitCount(bits), bitCount(added), bitCount(removed)));
    const EdgeTally groups_before = job.data.edge_tallies.at[group];
    append(EdgeList(job.data.slots), groups_before.silhouette + before.x, word, bits);
    if (job.data.lists_changes == 0u) return;
    append(EdgeList(job.data.added), groups_before.added + before.y, word, added);
    append(EdgeList(job.data.removed), groups_before.removed + before.z, word, removed);
}

void write_words(uint group) {
    if (job.data.lists_changes == 0u) return;
    const uint word = group * RIMLINE_GROUP_WORDS + gl_LocalInvocationIndex;
    const bool changed =
        word * 32u < job.data.face_count && job.data.face_changes.at[word] != 0u;
    const uvec3 before = sum_before(uvec3(changed ? 1u : 0u, 0u, 0u));
    if (changed)
        job.data.word_writes.at[job.data.face_tallies.at[group].words + before.x] =
            PlacedWrite(word, job.data.face_words.at[word]);
}

void main() {
    const uint group = group_index();
    const uint edge_groups = job.data.edge_group_count;
    if (group < edge_groups)
        write_edges(group);
    else if (group - edge_groups < job.data.face_group_count)
        write_words(group - edge_groups);
}
