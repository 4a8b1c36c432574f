#pragma once

// What the tests of shapes measure of a mesh.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline::tests {

inline glm::dvec3 corner(const Mesh& mesh, std::uint32_t face, std::uint32_t c) {
    return mesh.positions()[index(mesh.triangles()[face][c])];
}

/// Of a closed mesh: positive when its faces look outwards.
inline double signed_volume(const Mesh& mesh) {
    double six_volumes = 0.0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        six_volumes +=
            glm::dot(corner(mesh, f, 0), glm::cross(corner(mesh, f, 1), corner(mesh, f, 2)));
    return six_volumes / 6.0;
}

inline int euler_characteristic(const Mesh& mesh) {
    return static_cast<int>(mesh.vertex_count()) - static_cast<int>(mesh.edge_count()) +
           static_cast<int>(mesh.face_count());
}

/// The greatest angle between the normals of two faces that share an edge, in radians.
inline double sharpest_bend(const Mesh& mesh) {
    double min_cos = 1.0;
    for (const Edge& edge : mesh.edges()) {
        if (edge.faces[1] == k_no_face) continue;
        const Plane& a = mesh.plane(edge.faces[0]);
        const Plane& b = mesh.plane(edge.faces[1]);
        min_cos =
            std::min(min_cos, double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz);
    }
    return std::acos(min_cos);
}

/// For each face the component it belongs to, numbered by their first faces.
inline std::vector<std::uint32_t> components_of(const Mesh& mesh) {
    constexpr std::uint32_t k_unseen = 0xffffffffu;
    std::vector<std::uint32_t> component(mesh.face_count(), k_unseen);
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (component[f] != k_unseen) continue;
        std::vector<std::uint32_t> pending{f};
        component[f] = count;
        while (!pending.empty()) {
            const std::uint32_t at = pending.back();
            pending.pop_back();
            for (const EdgeId e : mesh.edges_of(FaceId{at})) {
                if (e == k_no_edge) continue;
                for (const FaceId next : mesh.faces_of(e)) {
                    if (component[index(next)] != k_unseen) continue;
                    component[index(next)] = count;
                    pending.push_back(index(next));
                }
            }
        }
        ++count;
    }
    return component;
}

/// Whether the segment from a to b passes through the inside of face f.
inline bool segment_hits(const Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b,
                         std::uint32_t f) {
    const glm::dvec3 p = corner(mesh, f, 0);
    const glm::dvec3 u = corner(mesh, f, 1) - p;
    const glm::dvec3 v = corner(mesh, f, 2) - p;
    const glm::dvec3 along = b - a;
    const glm::dvec3 h = glm::cross(along, v);
    const double det = glm::dot(u, h);
    // Parallel but for rounding: neighbors in one plane would seem to cut each other.
    if (std::abs(det) <= 1e-6 * glm::length(along) * glm::length(u) * glm::length(v)) return false;
    const glm::dvec3 s = a - p;
    const double x = glm::dot(s, h) / det;
    const glm::dvec3 q = glm::cross(s, u);
    const double y = glm::dot(along, q) / det;
    const double t = glm::dot(v, q) / det;
    constexpr double e = 1e-9;
    return x > e && y > e && x + y < 1.0 - e && t > e && t < 1.0 - e;
}

/// Whether two faces cut through each other: an edge of one through the inside of the other. Edges
/// that the faces share, or that end in a shared vertex, do not count as cutting there.
inline bool faces_intersect(const Mesh& mesh, std::uint32_t f, std::uint32_t g) {
    glm::dvec3 low_f = corner(mesh, f, 0), high_f = low_f, low_g = corner(mesh, g, 0),
               high_g = low_g;
    for (std::uint32_t c = 1; c < 3; ++c) {
        low_f = glm::min(low_f, corner(mesh, f, c));
        high_f = glm::max(high_f, corner(mesh, f, c));
        low_g = glm::min(low_g, corner(mesh, g, c));
        high_g = glm::max(high_g, corner(mesh, g, c));
    }
    for (int axis = 0; axis < 3; ++axis)
        if (low_f[axis] > high_g[axis] || low_g[axis] > high_f[axis]) return false;
    for (std::uint32_t c = 0; c < 3; ++c)
        if (segment_hits(mesh, corner(mesh, f, c), corner(mesh, f, (c + 1) % 3), g) ||
            segment_hits(mesh, corner(mesh, g, c), corner(mesh, g, (c + 1) % 3), f))
            return true;
    return false;
}

}  // namespace rimline::tests
