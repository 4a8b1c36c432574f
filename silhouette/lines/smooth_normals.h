#pragma once

// Normals of the smooth surface that a mesh stands for, at its vertices: each is the sum of the normals of the faces,
// with the weights for which it is exact on a sphere (Max, Weights for Computing Vertex Normals from Facet Normals,
// 1999). A normal is computed when it is asked for, and kept: the next view asks for most of them again.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/lines/line_frame.h"

namespace rimline {

class SmoothNormals {
public:
    /// Before the first call of facing() for a frame. All frames must have the same surface.
    void begin(const LineFrame& frame);

    /// Greater than 0 where the smooth surface through a vertex shows its front to the view's point, less than 0 where
    /// it shows its back. It is linear in the vertex's normal, so that it can be interpolated along an edge. O(1), the
    /// first time O(faces of the vertex).
    double facing(std::uint32_t vertex);

private:
    glm::vec3 find_normal(std::uint32_t vertex) const;

    const LineFrame* frame_ = nullptr;
    std::vector<glm::vec3> normals_;  // By vertex. The x of one that is not known is k_unknown.
};

}  // namespace rimline
