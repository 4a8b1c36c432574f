#ifndef RIMLINE_SHADERS_LAYOUT_H
#define RIMLINE_SHADERS_LAYOUT_H

// What C++ and GLSL both read, written down once. Everything is in scalar layout, addresses first, so
// that both languages place every member alike; the asserts at the end hold C++ to it.
//
// Buffers are reached by address, and have no limit on their size but the device's memory. There are
// descriptors for the pictures that a pass samples, and for what all invocations of a draw read alike:
// a load by address is each invocation's own, which a CPU that stands in for a GPU pays for.

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#define RIMLINE_ADDRESS(type) std::uint64_t
namespace rimline::gpu {
using uint = std::uint32_t;
using glm::mat3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define RIMLINE_ADDRESS(type) type
#endif

// An edge as it is cast and drawn. f0 runs it from v0 to v1. In the list of all edges f1 is the face
// on the other side where exactly two faces run it in opposite directions, else k_no_face: such an edge
// casts through the loose list, one record for each of its faces, with f1 = k_no_face.
struct EdgeRecord {
    uint v0;
    uint v1;
    uint f0;
    uint f1;
};

// A pair of faces at an edge that is not regular, for line paths that test every edge in every frame:
// the edge, as it stands in the list of all edges, is drawn when the bits of a and b differ or, where
// drawn_if_equal is 1, are equal. An edge with more faces has several pairs.
struct FacePairRecord {
    EdgeRecord edge;
    uint face_a;
    uint face_b;
    uint drawn_if_equal;
};

// A scattered write of a change set: target[place] = value.
struct PlacedWrite {
    uint place;
    uint value;
};

struct TriangleRecord {
    uint v0;
    uint v1;
    uint v2;
};

// An edge to be drawn as a line: the vertices it runs between.
struct LineEnds {
    uint from;
    uint to;
};

// VkDrawIndirectCommand.
struct DrawArguments {
    uint vertex_count;
    uint instance_count;
    uint first_vertex;
    uint first_instance;
};

// How the slots of a stream are drawn: a point each where a geometry shader follows, an instance of four
// vertices each, a strip, where the vertex shader does it all, or the side of a shadow volume each: one
// triangle where all rays of light end in one point, else two.
struct SlotArguments {
    DrawArguments points;
    DrawArguments strips;
    DrawArguments pointed_sides;
    DrawArguments sides;
};

#ifndef __cplusplus
const uint k_no_face = 0xffffffffu;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Positions {
    vec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles {
    TriangleRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CornerNormals {
    vec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer EdgeRecords {
    EdgeRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FacePairRecords {
    FacePairRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Planes { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Slots { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FaceWords {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LineList {
    LineEnds at[];
};
#endif

// One for each picture. Colors are linear light.
struct FrameData {
    vec2 clip_scale;    // clip.xy = clip_scale * eye.xy, so that the picture is |xy| <= w / guard
    vec2 clip_z;        // clip.z = clip_z.x * eye.z + clip_z.y * w
    vec2 clip_w;        // clip.w = clip_w.x * eye.z + clip_w.y * w
    vec2 extent;        // Width and height of the picture in the pass, in pixels.
    vec2 depth_place;   // Where in a pixel its one depth was taken: of samples, the first.
    float line_radius;  // Half of a line's width, in pixels of the pass.
    float hidden_strength;  // Of hidden lines' ink; 0: they are not drawn.
    float depth_slack;  // Depth by which a line may lie behind the surface it sits on, relative ...
    float depth_slack_absolute;  // ... and absolute.
    vec3 background;
    vec3 shade;           // What shadow leaves of a surface's color.
    float hatch_spacing;  // Between strokes, in pixels of the pass.
    float dash_period;    // Of hidden lines, in pixels of the pass; 0: they are not dashed.
    float dash_length;    // What of that is drawn.
    uint
        frozen_lines;  // 1: the silhouette is another point's, and runs over surfaces as creases do.
    float guard;  // How many times as wide and high as the picture the viewport is; a power of 2.
};

// As the enumerators of Style (engine/scene.h); a specialization constant of surface.frag.
#define RIMLINE_STYLE_INK 0
#define RIMLINE_STYLE_TOON 1
#define RIMLINE_STYLE_MASK 2
#define RIMLINE_STYLE_BLUEPRINT 3
#define RIMLINE_STYLE_HATCH 4

// What a draw of lines makes lines of (DrawConstants.choice).
#define RIMLINE_LINES_SILHOUETTE 0u  // The camera's streamed slots.
#define RIMLINE_LINES_BORDER 1u
#define RIMLINE_LINES_CREASE 2u
#define RIMLINE_LINES_TESTED 3u     // Every regular edge, those whose faces' planes say so.
#define RIMLINE_LINES_IRREGULAR 4u  // Every pair of faces at an irregular edge, likewise.

// One for each instance. Passes work in the mesh's own coordinates: positions are taken relative to
// the camera there before anything else, so that models far from the origin keep their precision.
struct InstanceData {
    RIMLINE_ADDRESS(Positions) positions;
    RIMLINE_ADDRESS(Triangles) triangles;
    RIMLINE_ADDRESS(CornerNormals) corner_normals;
    RIMLINE_ADDRESS(EdgeRecords) edges;
    RIMLINE_ADDRESS(EdgeRecords) loose_edges;
    RIMLINE_ADDRESS(EdgeRecords) borders;
    RIMLINE_ADDRESS(EdgeRecords) creases;
    RIMLINE_ADDRESS(Slots) slots;                      // The camera's silhouette.
    RIMLINE_ADDRESS(Planes) planes;                    // For line paths without slots ...
    RIMLINE_ADDRESS(FacePairRecords) irregular_pairs;  // ... else both are 0.
    mat3 eye_from_object;  // Rotation into the camera's axes: x right, y up, z towards the viewer.
    vec3 camera;           // The camera's position.
    vec4 viewpoint;        // The camera's silhouette point, homogeneous.
    vec3 center;           // Of the mesh.
    vec3 color;
    vec3 ink;           // Of its strokes.
    float fade_radius;  // Over 0: the surface fades into the background towards this distance ...
    vec3 fade_center;   // ... from here.
    uint padding;
};

// One for each pair of instance and light.
struct LightData {
    RIMLINE_ADDRESS(Slots) slots;
    RIMLINE_ADDRESS(FaceWords) face_words;
    vec4 point;  // Homogeneous, in the mesh's coordinates.
    vec3 color;  // Its share of a fully lit surface.
    float
        extrusion;  // 0: volumes reach infinity. Else how far (directional light) or how many times as
    // far as the edge (point light), for orthographic views, which infinity is not in.
};

// Push constants of every drawing pass.
struct DrawConstants {
    uint choice;  // What the pass's shader says.
};

// Push constants of the passes of a visible ratio: one viewpoint of one mesh.
struct RatioConstants {
    RIMLINE_ADDRESS(Positions) positions;
    RIMLINE_ADDRESS(LineList) lines;
    mat3 eye_from_object;  // Rotation into the camera's axes: x right, y up, z towards the viewer.
    vec3 camera;           // The viewpoint.
    vec2 clip_scale;       // clip.xy = clip_scale * eye.xy
    float near_distance;   // Of the near plane; clip.z everywhere.
    float side_px;         // Of the square picture.
};

#ifdef __cplusplus
static_assert(sizeof(RatioConstants) == 2 * 8 + 4 * (9 + 3 + 2 + 2));
static_assert(sizeof(LineEnds) == 8);
static_assert(sizeof(EdgeRecord) == 16 && sizeof(FacePairRecord) == 28 &&
              sizeof(PlacedWrite) == 8 && sizeof(TriangleRecord) == 12);
static_assert(sizeof(SlotArguments) == 64);
static_assert(sizeof(FrameData) == 4 * 25);
static_assert(sizeof(InstanceData) == 10 * 8 + 4 * (9 + 3 + 4 + 3 + 3 + 3 + 1 + 3 + 1));
static_assert(sizeof(LightData) == 2 * 8 + 4 * 8);
static_assert(sizeof(DrawConstants) == 4);
}  // namespace rimline::gpu
#endif

#endif
