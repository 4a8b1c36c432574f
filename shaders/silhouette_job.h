#ifndef RIMLINE_SHADERS_SILHOUETTE_JOB_H
#define RIMLINE_SHADERS_SILHOUETTE_JOB_H

// The data of a silhouette that is computed on the GPU (engine/stream/gpu_silhouette.h): inputs for faces and
// edges, outputs for bits and lists. In the scalar layout of layout.h.
//
// One invocation processes a word of 32 faces or 32 edges, and one workgroup 64 words. Only edges before the
// borders are processed. Their words hold a bit per edge, set if it is on the silhouette.

#include "layout.h"

#ifdef __cplusplus
namespace rimline::gpu {
#endif

// Invocations per workgroup, and words per group.
#define RIMLINE_GROUP_WORDS 64

// The two faces of a regular or inconsistent edge.
struct EdgeFaces {
    uint f0;
    uint f1;
};

// Sums over a group. After the scan: sums over all earlier groups.
struct FaceTally {
    uint words;  // Words of face bits that changed.
    uint flips;  // Faces whose bit changed.
};
struct EdgeTally {
    uint silhouette;
    uint regular;  // The regular edges among them.
    uint added;
    uint removed;
};

// Counts of changes and of the current silhouette.
struct SilhouetteCounts {
    uint silhouette;  // Used slots.
    uint regular;     // Used slots of regular edges, which come first.
    uint added;
    uint removed;
    uint words;
    uint flips;
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer EdgeFaceList {
    EdgeFaces at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Indices { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceTallies { FaceTally at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer EdgeTallies { EdgeTally at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer EdgeList {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordWrites {
    PlacedWrite at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer CountsOut {
    SilhouetteCounts data;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer ArgumentsOut {
    SlotArguments slots;
};
#endif

struct SilhouetteJob {
    RIMLINE_ADDRESS(Planes) planes;        // Used if from_planes is 1.
    RIMLINE_ADDRESS(Positions) positions;  // Used if from_planes is 0, as are the triangles.
    RIMLINE_ADDRESS(Triangles) triangles;
    RIMLINE_ADDRESS(EdgeFaceList) edge_faces;
    RIMLINE_ADDRESS(Indices) fan_begin;  // Faces of non-manifold edge i: fan_faces[fan_begin[i] ..
    RIMLINE_ADDRESS(Indices) fan_faces;  // fan_begin[i + 1]), i counted from two_face_end.
    RIMLINE_ADDRESS(Words) face_words;
    RIMLINE_ADDRESS(Words) face_changes;  // Bits that flipped since the previous run.
    RIMLINE_ADDRESS(Words) edge_words;
    RIMLINE_ADDRESS(Words) edge_changes;
    RIMLINE_ADDRESS(FaceTallies) face_tallies;
    RIMLINE_ADDRESS(EdgeTallies) edge_tallies;
    RIMLINE_ADDRESS(EdgeList) slots;
    RIMLINE_ADDRESS(EdgeList) added;
    RIMLINE_ADDRESS(EdgeList) removed;
    RIMLINE_ADDRESS(WordWrites) word_writes;
    RIMLINE_ADDRESS(CountsOut) counts;
    RIMLINE_ADDRESS(ArgumentsOut) arguments;
    uint from_planes;
    uint lists_changes;  // Whether added, removed and word_writes exist.
    uint face_count;
    uint regular_end;   // Edges [0, regular_end) are regular,
    uint two_face_end;  // [regular_end, two_face_end) inconsistent,
    uint edge_count;    // [two_face_end, edge_count) non-manifold.
    uint face_group_count;
    uint edge_group_count;
};

#ifdef __cplusplus
static_assert(sizeof(EdgeFaces) == 8 && sizeof(FaceTally) == 8 && sizeof(EdgeTally) == 16);
static_assert(sizeof(SilhouetteCounts) == 24);
static_assert(sizeof(SilhouetteJob) == 18 * 8 + 8 * 4);
}  // namespace rimline::gpu
#else
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer JobRef {
    SilhouetteJob data;
};

layout(push_constant, scalar) uniform Constants {
    JobRef job;
    vec4 point;
};

// Groups fill several rows, because large meshes exceed the limit of one row of a dispatch.
uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
#endif

#endif
