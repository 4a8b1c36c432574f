#include "silhouette/mesh/edge_convexity.h"

#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

// u x v · w and an upper bound of its error. For u, v and w that are differences rounded once, the bound
// is (7 + 56e)e times the sum of the absolute terms, e = 2^-53. No value overflows or is subnormal,
// because coordinates are floats.
struct Determinant {
    double value, error;
};
Determinant determinant(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) noexcept {
    const double xy = u.x * v.y;
    const double yx = u.y * v.x;
    const double yz = u.y * v.z;
    const double zy = u.z * v.y;
    const double zx = u.z * v.x;
    const double xz = u.x * v.z;
    const double sizes = (std::abs(xy) + std::abs(yx)) * std::abs(w.z) +
                         (std::abs(yz) + std::abs(zy)) * std::abs(w.x) +
                         (std::abs(zx) + std::abs(xz)) * std::abs(w.y);
    return {(xy - yx) * w.z + (yz - zy) * w.x + (zx - xz) * w.y, 0x8p-53 * sizes};
}

}  // namespace

EdgeConvexity edge_convexity(const Mesh& mesh, EdgeId edge) noexcept {
    if (mesh.edge_class(edge) != EdgeClass::regular) return EdgeConvexity::none;
    const Edge& e = mesh.edge(edge);
    const glm::dvec3 a(mesh.positions()[index(e.vertices[0])]);
    const glm::dvec3 b(mesh.positions()[index(e.vertices[1])]);
    const Determinant det = determinant(b - a, opposite_corner_of(mesh, e.faces[0], e) - a,
                                        opposite_corner_of(mesh, e.faces[1], e) - a);
    if (det.value < -det.error) return EdgeConvexity::convex;
    return det.value > det.error ? EdgeConvexity::concave : EdgeConvexity::flat;
}

std::vector<std::uint32_t> concave_edge_bits(const Mesh& mesh) {
    const std::uint32_t regular = mesh.edges_of_class(EdgeClass::regular).last;
    std::vector<std::uint32_t> bits((regular + 31) / 32, 0);
    for (std::uint32_t e = 0; e < regular; ++e)
        if (edge_convexity(mesh, EdgeId{e}) == EdgeConvexity::concave)
            bits[e / 32] |= 1u << (e % 32);
    return bits;
}

void remove_concave_edges(std::span<const std::uint32_t> concave_bits, std::vector<EdgeId>& edges) {
    std::erase_if(edges, [concave_bits](EdgeId edge) { return is_concave(concave_bits, edge); });
}

}  // namespace rimline
