#ifndef RIMLINE_SHADERS_LAYOUT_H
#define RIMLINE_SHADERS_LAYOUT_H

// Structures shared by C++ and GLSL. All are in scalar layout with addresses first, so that both
// languages place members equally. The asserts at the end check C++.
//
// Buffers are accessed by address, so only device memory limits their size. Descriptors are used for
// sampled images, and for data that all invocations of a draw read equally. A load by address is
// executed per invocation, which is slow on a CPU device.
//
// Lists of records of 16 bytes begin at multiples of 16: at the begin of a buffer (engine/vulkan/memory.h), or a
// number of records after it.

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#define RIMLINE_ADDRESS(type) std::uint64_t
#define RIMLINE_SHARED inline  // Of functions that both languages compile.
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
#define RIMLINE_SHARED
#endif

// An edge for shadow casting and drawing. f0 traverses it from v0 to v1. In the list of all edges, f1 is
// the second face of a regular edge (two faces that traverse it in opposite directions), else k_no_face.
// Edges that are not regular cast through the loose list, with one record per face and f1 = k_no_face.
struct EdgeRecord {
    uint v0;
    uint v1;
    uint f0;
    uint f1;
};

// A pair of faces at an edge that is not regular, for line paths that test every edge in every frame.
// `edge` is the record of the list of all edges. It is drawn if the bits of a and b differ, or, with
// drawn_if_equal 1, if they are equal. An edge with more than two faces has several pairs.
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

// The two vertices of an edge that is drawn as a line.
struct LineEnds {
    uint from;
    uint to;
};

// A segment of a line whose visibility is known, in pixels of the pass.
struct LineSegment {
    vec4 ends;       // Start and end.
    vec2 dashes;     // Positions of both ends in the dash pattern.
    float strength;  // Of its ink.
};

// VkDrawIndirectCommand.
struct DrawArguments {
    uint vertex_count;
    uint instance_count;
    uint first_vertex;
    uint first_instance;
};

// Draws of the slots of a stream. `points`: one point per slot, for a geometry shader. `strips`: one
// instance of a four-vertex strip per slot, for a vertex shader only. `pointed_sides` and `sides`: one
// side of a shadow volume per slot, with one triangle if all rays of light end in one point, else two.
struct SlotArguments {
    DrawArguments points;
    DrawArguments strips;
    DrawArguments pointed_sides;
    DrawArguments sides;
};

#ifndef __cplusplus
const uint k_no_face = 0xffffffffu;
const uint k_no_material = 0xffffffffu;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Positions {
    vec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles {
    TriangleRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CornerNormals {
    vec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer EdgeRecords {
    EdgeRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FacePairRecords {
    FacePairRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Planes { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Slots { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FaceWords {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FaceList {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MaterialList {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Colors { vec3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CornerUvs {
    vec2 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LineList {
    LineEnds at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LineSegments {
    LineSegment at[];
};
#endif

// One per picture. Colors are linear.
struct FrameData {
    // clip.xy = clip_scale * eye.xy + clip_shift * clip.w, so that the picture is |xy| <= w / guard
    vec2 clip_scale;
    vec2 clip_shift;
    vec2 clip_z;            // clip.z = clip_z.x * eye.z + clip_z.y * w
    vec2 clip_w;            // clip.w = clip_w.x * eye.z + clip_w.y * w
    vec2 extent;            // Width and height of the picture in the pass, in pixels.
    vec2 depth_place;       // Position of the depth sample in a pixel. The first of several.
    float line_radius;      // Half of a line's width, in pixels of the pass.
    float hidden_strength;  // Ink strength of hidden lines. 0: not drawn.
    float depth_slack;  // Depth by which a line may lie behind the surface it sits on, relative ...
    float depth_slack_absolute;  // ... and absolute.
    vec3 background;
    vec3 shade;           // Factor of a surface's color in shadow.
    float hatch_spacing;  // Between strokes, in pixels of the pass.
    float dash_period;    // Of hidden lines, in pixels of the pass. 0: not dashed.
    float dash_length;    // Drawn length per period.
    uint frozen_lines;    // 1: the silhouette of another point; it may cross surfaces like creases.
    float guard;          // Viewport size divided by picture size, a power of 2.
};

// Equal to the enumerators of Style (engine/scene.h). A specialization constant of surface.frag.
#define RIMLINE_STYLE_INK 0
#define RIMLINE_STYLE_TOON 1
#define RIMLINE_STYLE_MASK 2
#define RIMLINE_STYLE_BLUEPRINT 3
#define RIMLINE_STYLE_HATCH 4

// The edges that a draw of lines uses (DrawConstants.choice).
#define RIMLINE_LINES_SILHOUETTE 0u  // The camera's streamed slots.
#define RIMLINE_LINES_BORDER 1u
#define RIMLINE_LINES_CREASE 2u
#define RIMLINE_LINES_TESTED 3u     // All regular edges, tested by face planes.
#define RIMLINE_LINES_IRREGULAR 4u  // All face pairs at irregular edges, likewise.

// DrawConstants.choice of a draw of shapes: the instance has outlines, or it only hides those of others.
#define RIMLINE_SHAPE_OUTLINED 0u
#define RIMLINE_SHAPE_HIDING 2u

// How far the ink of a line reaches beyond its width, in pixels of the pass: half a pixel's diagonal for the edge,
// and an eighth for rounding.
#define RIMLINE_INK_REACH 0.8321

// InstanceData.stroke_inks: the color of strokes on surfaces in the colors of their mesh.
#define RIMLINE_STROKES_OWN 0u  // InstanceData.ink
#define RIMLINE_STROKES_DARK \
    1u  // line_shade() of the surface's color (silhouette/mesh/material_inks.h).
#define RIMLINE_STROKES_PALE 2u  // The same on dark paper.

// A bit of what the vertex shaders of surfaces say of a face (surface_corner.glsl): it has no material.
#define RIMLINE_UNPAINTED 4u

// Inks of lines (DrawConstants.material_ink) beside those of materials.
#define RIMLINE_ANY_INK 0xffffffffu
#define RIMLINE_OWN_INK 0xfffffffeu  // Of faces without a material.

// One per instance. Passes work in the mesh's coordinates. They first subtract the camera's position
// from each vertex, so that models far from the origin keep their precision.
struct InstanceData {
    RIMLINE_ADDRESS(Positions) positions;
    RIMLINE_ADDRESS(Triangles) triangles;
    RIMLINE_ADDRESS(CornerNormals) corner_normals;
    RIMLINE_ADDRESS(EdgeRecords) edges;
    RIMLINE_ADDRESS(EdgeRecords) loose_edges;
    RIMLINE_ADDRESS(EdgeRecords) borders;
    RIMLINE_ADDRESS(EdgeRecords) creases;
    RIMLINE_ADDRESS(Slots) slots;                      // The camera's silhouette.
    RIMLINE_ADDRESS(Planes) planes;                    // For line paths without slots, else 0.
    RIMLINE_ADDRESS(FacePairRecords) irregular_pairs;  // For line paths without slots, else 0.
    RIMLINE_ADDRESS(LineSegments) segments;  // Of lines whose visibility is known, else 0.
    // For surfaces in the colors of their mesh, else 0.
    RIMLINE_ADDRESS(Colors) materials;  // Base colors.
    RIMLINE_ADDRESS(MaterialList)
    face_materials;                         // Index in `materials` of each face, or k_no_material.
    RIMLINE_ADDRESS(Colors) corner_colors;  // If has_corner_colors is 1.
    // For lines in the colors of their surfaces, else 0: the ink of each face, a byte, 255 without a material.
    RIMLINE_ADDRESS(FaceWords) face_inks;
    RIMLINE_ADDRESS(CornerNormals) hull_normals;  // For outlines by back faces, else 0.
    // For surfaces with textures, else 0.
    RIMLINE_ADDRESS(FaceList) textured_faces;  // All faces, ordered by texture.
    RIMLINE_ADDRESS(CornerUvs) corner_uvs;
    // Rotation into the camera's axes: x right, y up, z towards the viewer. Times the instance's scale.
    mat3 eye_from_object;
    float inverse_scale;  // Of the instance.
    vec3 camera;          // The camera's position.
    vec4 viewpoint;       // The camera's silhouette point, homogeneous.
    vec3 center;          // Center of the mesh.
    vec3 color;
    vec3 ink;  // Color of its strokes.
    // If > 0, the surface fades into the background at this distance, in the mesh's coordinates, from ...
    float fade_radius;
    vec3 fade_center;  // ... this point.
    uint has_corner_colors;
    uint stroke_inks;  // A RIMLINE_STROKES_ value.
};

// One per pair of instance and light.
struct LightData {
    RIMLINE_ADDRESS(Slots) slots;
    RIMLINE_ADDRESS(FaceWords) face_words;
    RIMLINE_ADDRESS(EdgeRecords) part_sides;  // Of all parts of its volume. 0 if it is drawn whole.
    RIMLINE_ADDRESS(FaceList) part_faces;     // The same.
    vec4 point;                               // Homogeneous, in the mesh's coordinates.
    vec3 color;                               // Its share in the light of a fully lit surface.
    // 0: volumes reach infinity. RIMLINE_EXTRUDED_TO_ONE_POINT. Else their length, as a multiple: of the way from a
    // point light to the edge, or of `point`, a unit vector, for a directional light. For orthographic views, which do
    // not contain infinity.
    float extrusion;
};

// LightData.extrusion: all rays end in the light's point with its signs turned. A directional light's is at infinity.
// The rays of a point light pass through infinity to it, where depth is clamped to the farthest. For lights behind the
// camera.
#define RIMLINE_EXTRUDED_TO_ONE_POINT -1.0

// Push constants of every drawing pass.
struct DrawConstants {
    uint choice;  // Its meaning depends on the pass's shader.
    uint
        material_ink;  // Of line passes: draws only lines of this ink (InstanceData.face_inks), or any.
};

// Push constants of the Sobel operator.
struct SobelConstants {
    int low_x, low_y, high_x, high_y;  // The pixels that are drawn.
    int reach;                         // From a pixel to those that are compared.
    float depth_step;                  // Outline (engine/renderer_options.h).
    float normal_step;                 // Length of the difference of unit normals.
};

// Push constants of the passes of a visible ratio: one viewpoint of one mesh.
struct RatioConstants {
    RIMLINE_ADDRESS(Positions) positions;
    RIMLINE_ADDRESS(LineList) lines;
    mat3 eye_from_object;  // Rotation into the camera's axes: x right, y up, z towards the viewer.
    vec3 camera;           // The viewpoint.
    vec2 clip_scale;       // clip.xy = clip_scale * eye.xy
    float near_distance;   // Of the near plane. clip.z has this value everywhere.
    float side_px;         // Side of the square picture, in pixels.
};

#ifdef __cplusplus
static_assert(sizeof(RatioConstants) == 2 * 8 + 4 * (9 + 3 + 2 + 2));
static_assert(sizeof(LineEnds) == 8 && sizeof(LineSegment) == 28);
static_assert(sizeof(EdgeRecord) == 16 && sizeof(FacePairRecord) == 28 &&
              sizeof(PlacedWrite) == 8 && sizeof(TriangleRecord) == 12);
static_assert(sizeof(SlotArguments) == 64);
static_assert(sizeof(FrameData) == 4 * 27);
static_assert(sizeof(InstanceData) == 18 * 8 + 4 * (9 + 1 + 3 + 4 + 3 + 3 + 3 + 1 + 3 + 1 + 1));
static_assert(sizeof(LightData) == 4 * 8 + 4 * 8);
static_assert(sizeof(DrawConstants) == 8 && sizeof(SobelConstants) == 28);
}  // namespace rimline::gpu
#endif

#endif
