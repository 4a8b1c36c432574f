#ifndef RIMLINE_SHADERS_DEFORM_JOB_H
#define RIMLINE_SHADERS_DEFORM_JOB_H

// A mesh whose positions are recomputed every frame (engine/stream/deforming_mesh.h). In the scalar layout
// of layout.h.

#include "layout.h"

// Invocations per workgroup. (glslang gives 1 for gl_WorkGroupSize before the layout declaration.)
#define RIMLINE_DEFORM_GROUP 64

#ifdef __cplusplus
namespace rimline::gpu {
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer DeformIndices {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MovedVectors { vec3 at[]; };
#endif

struct DeformJob {
    RIMLINE_ADDRESS(Positions) rest;
    RIMLINE_ADDRESS(MovedVectors) positions;
    RIMLINE_ADDRESS(Triangles) triangles;
    RIMLINE_ADDRESS(DeformIndices) group_begin;
    RIMLINE_ADDRESS(DeformIndices) group_corners;
    RIMLINE_ADDRESS(MovedVectors) corner_normals;
    uint vertex_count;
    uint group_count;
};

// position = rest + reach * sin(2 pi (per_length . (rest - center) - turns))
struct WaveConstants {
    vec3 center;
    vec3 per_length;  // Direction of the wave, divided by its length.
    vec3 reach;       // Direction of vertex movement, times the amplitude.
    float turns;
};

#ifdef __cplusplus
static_assert(sizeof(DeformJob) == 6 * 8 + 2 * 4);
static_assert(sizeof(WaveConstants) == 40);
}  // namespace rimline::gpu
#else
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer JobRef {
    DeformJob data;
};

layout(push_constant, scalar) uniform Constants {
    JobRef job;
    WaveConstants wave;
};

uint invocation_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * RIMLINE_DEFORM_GROUP +
           gl_LocalInvocationIndex;
}
#endif

#endif
