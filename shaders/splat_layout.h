#ifndef RIMLINE_SHADERS_SPLAT_LAYOUT_H
#define RIMLINE_SHADERS_SPLAT_LAYOUT_H

// Structures for drawing point clouds, shared by C++ and GLSL: discs and lines.

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#define RIMLINE_SPLAT_ADDRESS(type) std::uint64_t
namespace rimline::gpu {
using uint = std::uint32_t;
using glm::mat3;
using glm::vec2;
using glm::vec3;
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define RIMLINE_SPLAT_ADDRESS(type) type
#endif

// A disc around a point. Without a normal it faces the camera. A cut is a direction: the part of the disc
// on the opposite side of the center is removed, so that the discs of two faces meet in the crease between
// them.
struct SplatRecord {
    vec3 position;
    float radius;
    vec3 normal;   // Unit vector in either orientation, or zero.
    uint color;    // sRGB, one byte each, red in the lowest. Highest byte 255: not shaded.
    vec3 cuts[3];  // Zero for no cut.
};

// A line with round ends. Its width on the screen is constant. Its ends lie on the surface, which discs
// only approximate. Each end is moved towards the camera by the possible height of discs, but at most half
// the distance to the camera.
struct StrokeRecord {
    vec3 from;
    float radius;  // Half its width, in pixels of the picture.
    vec3 to;
    uint color;  // As above. Never shaded.
    vec2 lifts;  // Distances to move `from` and `to`.
};

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Splats {
    SplatRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Strokes {
    StrokeRecord at[];
};
#endif

struct SplatConstants {
    RIMLINE_SPLAT_ADDRESS(Splats) splats;
    RIMLINE_SPLAT_ADDRESS(Strokes) strokes;
    mat3 eye_from_world;
    vec3 camera;      // Its position.
    vec2 clip_scale;  // As in FrameData (layout.h).
    vec2 clip_shift;
    vec2 clip_z;
    vec2 clip_w;
    vec2 half_extent;  // Half the width and height of the pass, in pixels.
    float guard;       // Viewport size divided by the size of the pass.
    float scale;       // Pixels of the pass per pixel of the picture.
};

#ifdef __cplusplus
static_assert(sizeof(SplatRecord) == 68 && sizeof(StrokeRecord) == 40);
static_assert(sizeof(SplatConstants) == 112);
}  // namespace rimline::gpu
#endif

#endif
