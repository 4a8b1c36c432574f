#ifndef RIMLINE_SHADERS_SLOT_ARGUMENTS_GLSL
#define RIMLINE_SHADERS_SLOT_ARGUMENTS_GLSL

#include "layout.h"

// The arguments of all draws in SlotArguments for the first `count` slots.
SlotArguments slot_arguments(uint count) {
    return SlotArguments(DrawArguments(count, 1u, 0u, 0u), DrawArguments(4u, count, 0u, 0u),
                         DrawArguments(3u * count, 1u, 0u, 0u), DrawArguments(6u * count, 1u, 0u, 0u));
}

#endif
