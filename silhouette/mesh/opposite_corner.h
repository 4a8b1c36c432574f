#pragma once

#include "silhouette/mesh/mesh.h"

namespace rimline {

inline bool has_corner(const Triangle& face, VertexId vertex) noexcept {
    return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

/// The corner of a face that is not on `edge`, one of its edges.
inline VertexId opposite_corner(const Triangle& face, const Edge& edge) noexcept {
    for (const VertexId v : face)
        if (v != edge.vertices[0] && v != edge.vertices[1]) return v;
    return face[0];  // Not reached: faces with equal corners have no edges.
}

/// Its position.
inline glm::dvec3 opposite_corner_of(const Mesh& mesh, FaceId face, const Edge& edge) noexcept {
    return glm::dvec3(
        mesh.positions()[index(opposite_corner(mesh.triangles()[index(face)], edge))]);
}

}  // namespace rimline
