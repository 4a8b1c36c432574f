#version 460
#extension GL_GOOGLE_include_directive : require
#include "silhouette_job.h"
#include "slot_arguments.h"

// Step 3 of 4: replaces the tallies of groups by sums over all earlier groups, so that lists are in the
// order of faces and edges. Workgroup 0 sums the edges' tallies, and workgroup 1 the faces'. Each then
// writes the totals. A tally covers 2048 faces or edges, so 2^30 of them take only 4096 rounds. Devices need not
// support larger workgroups.

layout(local_size_x = 128) in;

shared uvec4 sums[128];

uvec4 load(bool edges, uint group) {
    if (edges) {
        const EdgeTally t = job.data.edge_tallies.at[group];
        return uvec4(t.silhouette, t.regular, t.added, t.removed);
    }
    const FaceTally t = job.data.face_tallies.at[group];
    return uvec4(t.words, t.flips, 0u, 0u);
}

void store(bool edges, uint group, uvec4 sum) {
    if (edges)
        job.data.edge_tallies.at[group] = EdgeTally(sum.x, sum.y, sum.z, sum.w);
    else
        job.data.face_tallies.at[group] = FaceTally(sum.x, sum.y);
}

void main() {
    const uint lane = gl_LocalInvocationIndex;
    const bool edges = gl_WorkGroupID.x == 0u;
    const uint count = edges ? job.data.edge_group_count : job.data.face_group_count;
    uvec4 before = uvec4(0u);
    for (uint first = 0u; first < count; first += 128u) {
        const uint group = first + lane;
        const uvec4 own = group < count ? load(edges, group) : uvec4(0u);
        sums[lane] = own;
        barrier();
        for (uint reach = 1u; reach < 128u; reach *= 2u) {
            const uvec4 other = lane >= reach ? sums[lane - reach] : uvec4(0u);
            barrier();
            sums[lane] += other;
            barrier();
        }
        if (group < count) store(edges, group, before + sums[lane] - own);
        before += sums[127];
        barrier();
    }
    if (lane != 0u) return;
    if (edges) {
        job.data.counts.data.silhouette = before.x;
        job.data.counts.data.regular = before.y;
        job.data.counts.data.added = before.z;
        job.data.counts.data.removed = before.w;
        job.data.arguments.slots = slot_arguments(before.x);
    } else {
        job.data.counts.data.words = before.x;
        job.data.counts.data.flips = before.y;
    }
}
