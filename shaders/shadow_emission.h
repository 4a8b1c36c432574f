#ifndef RIMLINE_SHADERS_SHADOW_EMISSION_H
#define RIMLINE_SHADERS_SHADOW_EMISSION_H

// The corners of the triangles of a shadow volume. Shaders use them for drawing, and a C++ test proves
// that volumes are closed (tests/engine/passes/shadow_boundary_test.cpp). The same code is compiled for
// both.
//
// A volume is a chain of oriented triangles over the vertices of a mesh. Each vertex is near (its
// position) or far (the end of its light ray). A face casts a light cap, a dark cap and three sides. If
// two faces of a volume share an edge, their sides there cancel and are not drawn.
//
//     light cap   n0 n1 n2             side of the edge a -> b, of the face on its left:
//     dark cap    f0 f2 f1                 nb na fb,  na fa fb
//
// The volume of a face that the light sees from behind is reversed.

#include "layout.h"

#ifdef __cplusplus
namespace rimline::gpu {
#endif

struct VolumeCorner {
    uint vertex;
    bool is_far;
};

// Corner 0 to 2 of the light cap or dark cap of a face that the light sees from the front.
RIMLINE_SHARED VolumeCorner cap_corner(TriangleRecord triangle, bool is_dark, uint corner) {
    const uint turned = is_dark ? (3u - corner) % 3u : corner;
    VolumeCorner result;
    result.vertex = turned == 0u ? triangle.v0 : turned == 1u ? triangle.v1 : triangle.v2;
    result.is_far = is_dark;
    return result;
}

// Corner 0 to 5 of the two triangles of an edge's side. If all rays end in one point, the second
// triangle has no area, and only corners 0 to 2 are used.
RIMLINE_SHARED VolumeCorner side_corner(EdgeRecord edge, bool is_front, uint corner) {
    VolumeCorner result;
    // Corners 0, 2 and 5 are b. If f0 is front, b is the edge's end.
    const bool is_end = corner == 0u || corner == 2u || corner == 5u;
    result.vertex = is_end == is_front ? edge.v1 : edge.v0;
    result.is_far = corner == 2u || corner > 3u;
    return result;
}

// The lists of sides to draw (DrawConstants.choice).
#define RIMLINE_SIDES_SLOTS 0u  // Silhouette slots: regular edges whose faces' bits differ.
#define RIMLINE_SIDES_LOOSE 1u  // The loose list: one record per face of every other edge.
#define RIMLINE_SIDES_PARTS 2u  // Sides of parts of the volume, one record each.
// Flag: only faces that the light sees from the front cast.
#define RIMLINE_SIDES_SINGLE 4u

// The caps to draw: those of faces whose bit is bit 0 of DrawConstants.choice. Flag: of the faces listed for
// parts of the volume, else of all.
#define RIMLINE_CAPS_PART 2u

#ifdef __cplusplus
}  // namespace rimline::gpu
#endif

#endif
