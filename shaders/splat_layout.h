#ifndef RIMLINE_SHADERS_SPLAT_LAYOUT_H
#define RIMLINE_SHADERS_SPLAT_LAYOUT_H

// What C++ and GLSL both read of a point cloud as it is drawn: discs and lines.

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

// A disc about a point. Without a normal it faces the camera. What lies on the other side of a cut than
// its direction is left out: so the discs of two faces meet in the crease between them.
struct SplatRecord {
    vec3 position;
    float radius;
    vec3 normal;   // Of length 1, either way round, or zero.
    uint color;    // sRGB, a byte each, red in the lowest; 255 in the highest: not shaded.
    vec3 cuts[2];  // Zero: none.
};

// A line with round ends, of the same width near and far. Its ends lie on the surface that discs only
// approximate: each is moved towards the camera by what discs may stand out, never more than half the way.
struct StrokeRecord {
    vec3 from;
    float radius;  // Half its width, in pixels of the picture.
    vec3 to;
    uint color;  // As above; never shaded.
    vec2 lifts;  // Of `from` and of `to`, lengths.
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
    vec3 camera;      // Where it stands.
    vec2 clip_scale;  // As FrameData has them (layout.h).
    vec2 clip_z;
    vec2 clip_w;
    vec2 half_extent;  // Of the pass: half its width and height in pixels, ...
    float guard;       // ... and how many times larger its viewport is.
    float scale;       // Pixels of the pass in one of the picture.
};

#ifdef __cplusplus
static_assert(sizeof(SplatRecord) == 56 && sizeof(StrokeRecord) == 40);
static_assert(sizeof(SplatConstants) == 104);
}  // namespace rimline::gpu
#endif

#endif
