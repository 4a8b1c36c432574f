#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "slot_arguments.h"

// Scatters the writes of a change set into slots and face words, and writes the draw arguments for
// the silhouette's size. Each place occurs only once (silhouette/hough/change_set.h), so any order is
// valid.

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Writes { PlacedWrite at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Target { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Arguments {
    SlotArguments slots;
};

layout(push_constant, scalar) uniform Constants {
    Writes slot_writes;
    Writes word_writes;
    Target slots;
    Target face_words;
    Arguments arguments;
    uint slot_write_count;
    uint word_write_count;
    uint silhouette_size;
};

void main() {
    const uint first = gl_GlobalInvocationID.x;
    const uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (first == 0u) arguments.slots = slot_arguments(silhouette_size);
    for (uint i = first; i < slot_write_count; i += stride) {
        const PlacedWrite write = slot_writes.at[i];
        slots.at[write.place] = write.value;
    }
    for (uint i = first; i < word_write_count; i += stride) {
        const PlacedWrite write = word_writes.at[i];
        face_words.at[write.place] = write.value;
    }
}
