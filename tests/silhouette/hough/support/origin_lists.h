#pragma once

// Where Hough spaces may have their origins: on the mesh, beside it, far from it, and several at once.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline::tests {

inline std::vector<std::vector<glm::dvec3>> origin_lists(const Mesh& mesh) {
    const double r = mesh.radius();
    const glm::dvec3 c = mesh.center();
    const glm::dvec3 zero(0.0);
    const glm::dvec3 vertex = mesh.vertex_count() > 0 ? glm::dvec3(mesh.positions()[0]) : c;
    const glm::dvec3 beside = c + glm::dvec3(r / 3.0, r / 7.0, -r / 5.0);
    const glm::dvec3 outside = c + glm::dvec3(-1.4 * r, 0.3 * r, 1.1 * r);
    const glm::dvec3 far = c + glm::dvec3(0.0, 100.0 * r, 0.0);
    return {{zero},      {vertex},         {beside},        {far},
            {c, beside}, {beside, beside}, {zero, outside}, {vertex, outside, far, c, beside}};
}

/// An origin in the planes of two faces that share an edge, as rounded as double allows: neither can say
/// on which side of it the origin lies. The center where there is no such edge.
inline glm::dvec3 origin_in_two_planes(const Mesh& mesh, std::uint32_t seed) {
    const std::uint32_t regular = mesh.edges_of_class(EdgeClass::regular).size();
    for (std::uint32_t i = 0; i < regular && i < 20; ++i) {
        const Edge& edge = mesh.edge(EdgeId{(seed + i * 7919u) % regular});
        const Plane& a = mesh.plane(edge.faces[0]);
        const Plane& b = mesh.plane(edge.faces[1]);
        const glm::dvec3 n(a.nx, a.ny, a.nz);
        const glm::dvec3 m(b.nx, b.ny, b.nz);
        const glm::dvec3 along = glm::cross(n, m);
        const glm::dvec3 corner(mesh.positions()[index(edge.vertices[0])]);
        const glm::dmat3 normals(n, m, along);  // As columns.
        if (!(glm::dot(along, along) > 1e-6)) continue;
        return glm::dvec3(a.d, b.d, glm::dot(along, corner)) * glm::inverse(normals);
    }
    return mesh.center();
}

}  // namespace rimline::tests
