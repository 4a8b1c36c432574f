#ifndef RIMLINE_SHADERS_LINE_EDGE_GLSL
#define RIMLINE_SHADERS_LINE_EDGE_GLSL

// The edges that a draw uses, by draw.choice (RIMLINE_LINES_, layout.h). The streamed slots hold
// silhouette edges only. The comparators get all edges and test each in every frame.

#include "draw.glsl"
#include "face_bit.glsl"

const uint k_no_corner = 0xffffffffu;

// An edge and the opposite corners of its faces.
struct LineEdge {
    uint v0;
    uint v1;
    uint corner_0;
    uint corner_1;  // k_no_corner if there is no second face.
};

uint corner_across(uint face, uint v0, uint v1) {
    if (face == k_no_face) return k_no_corner;
    const TriangleRecord triangle = instance.triangles.at[face];
    uint corner = triangle.v0;
    if (corner == v0 || corner == v1) corner = triangle.v1;
    if (corner == v0 || corner == v1) corner = triangle.v2;
    return corner;
}

// Sums may be rounded in another way here, so a comparator can differ from the tracker (face_bit.glsl).
bool is_front_here(uint face) {
    return is_front(instance.planes.at[face], instance.viewpoint);
}

// The distance of the viewer from the plane of a face; its rate for a viewer at infinity. Negative behind it.
float viewer_height(uint face) {
    const TriangleRecord triangle = instance.triangles.at[face];
    const vec3 origin = instance.positions.at[triangle.v0];
    const vec3 across = cross(instance.positions.at[triangle.v1] - origin,
                              instance.positions.at[triangle.v2] - origin);
    return dot(across, instance.viewpoint.xyz - instance.viewpoint.w * origin) / length(across);
}

// The ink of the face beside an edge that is turned most towards the viewer: the front of a silhouette.
uint ink_of(EdgeRecord edge) {
    const bool is_second =
        edge.f1 != k_no_face && viewer_height(edge.f1) > viewer_height(edge.f0);
    const uint face = is_second ? edge.f1 : edge.f0;
    const uint ink = instance.face_inks.at[face >> 2] >> 8 * (face & 3) & 0xff;
    return ink == 0xff ? RIMLINE_OWN_INK : ink;
}

// Returns false if the edge of this number is not drawn.
bool read_line_edge(uint number, out LineEdge line) {
    EdgeRecord edge;
    if (draw.choice == RIMLINE_LINES_SILHOUETTE) {
        edge = instance.edges.at[instance.slots.at[number]];
    } else if (draw.choice == RIMLINE_LINES_BORDER) {
        edge = instance.borders.at[number];
    } else if (draw.choice == RIMLINE_LINES_CREASE) {
        edge = instance.creases.at[number];
    } else if (draw.choice == RIMLINE_LINES_TESTED) {
        edge = instance.edges.at[number];
        if (is_front_here(edge.f0) == is_front_here(edge.f1)) return false;
    } else {
        const FacePairRecord pair = instance.irregular_pairs.at[number];
        edge = pair.edge;
        if ((is_front_here(pair.face_a) == is_front_here(pair.face_b)) != (pair.drawn_if_equal == 1u))
            return false;
    }
    if (draw.material_ink != RIMLINE_ANY_INK && ink_of(edge) != draw.material_ink) return false;
    line = LineEdge(edge.v0, edge.v1, corner_across(edge.f0, edge.v0, edge.v1),
                    corner_across(edge.f1, edge.v0, edge.v1));
    return true;
}

#endif
