#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"

// For tools/samples/embedding.cpp: reads the GPU data of a change stream. Any shader may do so.

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Arguments {
    SlotArguments slots;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Result {
    uint edges;
    uint edge_number_sum;
    uint front_faces;
};

layout(push_constant, scalar) uniform Constants {
    Slots slots;
    FaceWords face_words;
    Arguments arguments;
    Result result;
    uint word_count;
};

void main() {
    const uint first = gl_GlobalInvocationID.x;
    const uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    const uint edge_count = arguments.slots.points.vertex_count;
    if (first == 0u) result.edges = edge_count;
    for (uint i = first; i < edge_count; i += stride) atomicAdd(result.edge_number_sum, slots.at[i]);
    for (uint i = first; i < word_count; i += stride)
        atomicAdd(result.front_faces, uint(bitCount(face_words.at[i])));
}
