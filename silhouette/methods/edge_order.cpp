#include "silhouette/methods/edge_order.h"

#include <glm/geometric.hpp>

#include "silhouette/methods/packed_tree.h"

namespace rimline {

std::vector<EdgeId> edges_by_plane(const Mesh& mesh) {
    const glm::dvec3 center = mesh.center();
    const double scale = mesh.radius() > 0.0 ? 1.0 / mesh.radius() : 0.0;
    std::vector<EdgeId> edges;
    std::vector<PackedKey> keys;
    for (std::uint32_t e = 0; e < mesh.edges_of_class(EdgeClass::regular).last; ++e) {
        const std::array<FaceId, 2>& faces = mesh.edge(EdgeId{e}).faces;
        const Plane& a = mesh.plane(faces[0]);
        const Plane& b = mesh.plane(faces[1]);
        if (!a.has_normal() || !b.has_normal()) continue;
        const glm::dvec3 n = 0.5 * (glm::dvec3(a.nx, a.ny, a.nz) + glm::dvec3(b.nx, b.ny, b.nz));
        const double d = 0.5 * (double{a.d} + double{b.d}) - glm::dot(n, center);
        edges.push_back(EdgeId{e});
        keys.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
                        static_cast<float>(d * scale)});
    }
    std::vector<EdgeId> ordered;
    ordered.reserve(edges.size());
    for (const std::uint32_t i : packed_order(keys)) ordered.push_back(edges[i]);
    return ordered;
}

}  // namespace rimline
