#ifndef RIMLINE_SHADERS_FIELD_JOB_H
#define RIMLINE_SHADERS_FIELD_JOB_H

// The input of field.comp: planes, pieces of a tangential distance function, points.

#include "layout.h"

#ifdef __cplusplus
namespace rimline::gpu {
#endif

const uint k_field_tile = 64u;         // Planes that a workgroup evaluates at a time.
const uint k_field_group_points = 8u;  // Points per workgroup.
const uint k_field_chunk_tiles = 16u;  // Tiles per partial sum. The host adds the sums.

struct FieldPlane {
    vec3 normal;
    float offset;
    float weight;  // 0 for padding in the last tile.
};

// For distances >= from: ((c3*t + c2)*t + c1)*t + c0 with t = distance - start.
struct FieldPiece {
    float from;
    float start;
    float c0;
    float c1;
    float c2;
    float c3;
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FieldPlanes {
    FieldPlane at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FieldPieces {
    FieldPiece at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FieldSums {
    float at[];
};
#endif

struct FieldJob {
    RIMLINE_ADDRESS(FieldPlanes) planes;
    RIMLINE_ADDRESS(FieldPieces) pieces;
    RIMLINE_ADDRESS(Positions) points;
    RIMLINE_ADDRESS(FieldSums) sums;  // Indexed by chunk, then point.
    uint tile_count;
    uint piece_count;
    uint point_count;
    uint first_chunk;
};

#ifdef __cplusplus
static_assert(sizeof(FieldPlane) == 20 && sizeof(FieldPiece) == 24 && sizeof(FieldJob) == 48);
}  // namespace rimline::gpu
#endif

#endif
