#ifndef RIMLINE_SHADERS_SLOT_ARGUMENTS_H
#define RIMLINE_SHADERS_SLOT_ARGUMENTS_H

// The draw arguments of a silhouette. Shaders write them, and the host compares them with its own
// (engine/stream/consistency_check.h). The same code is compiled for both.

#include "layout.h"

#ifdef __cplusplus
namespace rimline::gpu {
#endif

// The arguments of all draws in SlotArguments for the first `count` slots.
RIMLINE_SHARED SlotArguments slot_arguments(uint count) {
    DrawArguments draw;
    draw.vertex_count = count;
    draw.instance_count = 1u;
    draw.first_vertex = 0u;
    draw.first_instance = 0u;
    SlotArguments result;
    result.points = draw;
    draw.vertex_count = 3u * count;
    result.pointed_sides = draw;
    draw.vertex_count = 6u * count;
    result.sides = draw;
    draw.vertex_count = 4u;
    draw.instance_count = count;
    result.strips = draw;
    return result;
}

#ifdef __cplusplus
}  // namespace rimline::gpu
#endif

#endif
