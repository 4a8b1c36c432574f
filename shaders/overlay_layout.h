#ifndef RIMLINE_SHADERS_OVERLAY_LAYOUT_H
#define RIMLINE_SHADERS_OVERLAY_LAYOUT_H

// Structures of an overlay, shared by C++ and GLSL: panels, letters and handles over a finished
// picture.

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec2.hpp>
#define RIMLINE_OVERLAY_ADDRESS(type) std::uint64_t
namespace rimline::gpu {
using uint = std::uint32_t;
using glm::vec2;
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define RIMLINE_OVERLAY_ADDRESS(type) type
#endif

struct OverlayVertex {
    vec2 place;    // In the units of OverlayConstants.
    vec2 texture;  // (0, 0) is the corner of the first texel, (1, 1) the opposite corner.
    uint color;    // sRGB and alpha, one byte each, red in the lowest byte.
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer OverlayVertices {
    OverlayVertex at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer OverlayIndices {
    uint at[];
};
#endif

struct OverlayConstants {
    RIMLINE_OVERLAY_ADDRESS(OverlayVertices) vertices;
    RIMLINE_OVERLAY_ADDRESS(OverlayIndices) indices;
    vec2 origin;     // Upper left corner of the picture.
    vec2 unit_size;  // Width and height of the picture.
};

#ifdef __cplusplus
static_assert(sizeof(OverlayVertex) == 20 && sizeof(OverlayConstants) == 32);
}  // namespace rimline::gpu
#endif

#endif
