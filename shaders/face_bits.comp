#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "round_to_even.glsl"
#include "face_bit.glsl"

// Face bits from planes: one word of 32 faces per invocation.

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Words { uint at[]; };

layout(push_constant, scalar) uniform Constants {
    Planes planes;
    Words words;
    vec4 point;
    uint face_count;
};

void main() {
    const uint word = gl_GlobalInvocationID.x;
    if (word >= (face_count + 31u) / 32u) return;
    uint bits = 0u;
    const uint first = word * 32u;
    const uint count = min(32u, face_count - first);
    for (uint i = 0u; i < count; ++i)
        if (is_front(planes.at[first + i], point)) bits |= 1u << i;
    words.at[word] = bits;
}
