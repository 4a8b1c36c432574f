#ifndef RIMLINE_SHADERS_SILHOUETTE_JOB_H
#define RIMLINE_SHADERS_SILHOUETTE_JOB_H

// One silhouette that the GPU finds by itself (engine/stream/gpu_silhouette.h): where its faces and edges are
// read, and where its bits and lists are written. In the scalar layout of layout.h.
//
// 32 faces, or 32 edges, are a word and one invocation's; 64 words are a workgroup's. Edges are those
// below the borders: their words hold a bit for each edge on the silhouette.

#include "layout.h"

#ifdef __cplusplus
namespace rimline::gpu {
#endif

// Invocations of a workgroup, words of a group.
#define RIMLINE_GROUP_WORDS 64

// The two faces of a regular or inconsistent edge.
struct EdgeFaces {
    uint f0;
    uint f1;
};

// Sums over a group, and after the scan over all groups before it.
struct FaceTally {
    uint words;  // Words of face bits that changed.
    uint flips;  // Faces that turned.
};
struct EdgeTally {
    uint silhouette;
    uint regular;  // Of them, those of two faces that run them in opposite directions.
    uint added;
    uint removed;
};

// What changed, and what there is now.
struct SilhouetteCounts {
    uint silhouette;  // Slots in use.
    uint regular;     // Slots in use of regular edges: the first ones.
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
    RIMLINE_ADDRESS(Planes) planes;  // Of the faces, where from_planes; else ...
    RIMLINE_ADDRESS(Positions) positions;
    RIMLINE_ADDRESS(Triangles) triangles;
    RIMLINE_ADDRESS(EdgeFaceList) edge_faces;
    RIMLINE_ADDRESS(Indices) fan_begin;  // Faces of non-manifold edge i: fan_faces[fan_begin[i] ..
    RIMLINE_ADDRESS(Indices) fan_faces;  // fan_begin[i + 1]), i counted from two_face_end.
    RIMLINE_ADDRESS(Words) face_words;
    RIMLINE_ADDRESS(Words) face_changes;  // What flipped since the run before.
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
    uint lists_changes;  // Whether added, removed and word_writes are there.
    uint face_count;
    uint regular_end;   // Edges before this are regular, ...
    uint two_face_end;  // those before this run the same way in both faces, ...
    uint edge_count;    // and those before this have three faces or more.
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

// Groups fill rows, for a row of a dispatch has a limit that large meshes pass.
uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
#endif

#endif
