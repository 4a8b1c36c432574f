#pragma once

// Where the contour of the smooth surface passes beside a vertex of a silhouette.
//
// The silhouette of a mesh zigzags from edge to edge. The surface that the mesh stands for has a contour that does
// not: n · (eye - p) = 0, where the normal n is interpolated between the vertices (Hertzmann, Zorin, Illustrating
// Smooth Surfaces, 2000). Its visibility would be inconsistent with the mesh (Bénard, Hertzmann, Line Drawings from
// 3D Models, 2019, section 4.4). So lines keep the visibility of the mesh, and their points move to the nearest
// point of that contour in the picture, within the faces at the vertex.

#include <cstdint>
#include <glm/vec2.hpp>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/smooth_normals.h"

namespace rimline {

class SmoothContour {
public:
    /// Before the first shift of a view. No shift is longer than `tolerance`, in picture coordinates. Vertices at
    /// an edge that bends by `crease_angle_rad` do not move: there the mesh is the surface. `normals` are those of
    /// the frame.
    void begin(const LineFrame& frame, double tolerance, float crease_angle_rad,
               SmoothNormals& normals);

    /// How far a vertex moves in the picture. O(faces of the vertex).
    glm::dvec2 shift_of(std::uint32_t vertex);

private:
    const LineFrame* frame_ = nullptr;
    SmoothNormals* normals_ = nullptr;
    double tolerance_ = 0.0;
    float crease_angle_rad_ = 0.0f;
};

}  // namespace rimline
