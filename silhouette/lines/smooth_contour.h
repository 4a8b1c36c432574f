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
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/lines/line_frame.h"

namespace rimline {

class SmoothContour {
public:
    /// Before the first shift of a view. No shift is longer than `tolerance`, in picture coordinates. Vertices at
    /// an edge that bends by `crease_angle_rad` do not move: there the mesh is the surface.
    void begin(const LineFrame& frame, double tolerance, float crease_angle_rad);

    /// How far a vertex moves in the picture. O(faces of its neighbors); remembered until begin().
    glm::dvec2 shift_of(std::uint32_t vertex);

private:
    // n · (eye - p): positive where the smooth surface faces the eye.
    double facing_of(std::uint32_t vertex);
    glm::dvec2 find_shift(std::uint32_t vertex);
    bool is_at_crease(std::uint32_t vertex) const;

    const LineFrame* frame_ = nullptr;
    double tolerance_ = 0.0;
    float crease_angle_rad_ = 0.0f;
    // By vertex, valid where the stamp is that of the view.
    std::uint32_t view_number_ = 0;
    std::vector<std::uint32_t> facing_stamps_, shift_stamps_;
    std::vector<double> facings_;
    std::vector<glm::dvec2> shifts_;
};

}  // namespace rimline
