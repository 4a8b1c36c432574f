#include "silhouette/mesh/edge_visibility.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/creases.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_edges_a_task = 4096;

// Whether the four corners of an edge of two faces are in one plane but for rounding.
bool is_flat(const Mesh& mesh, EdgeId edge) noexcept {
    const Edge& e = mesh.edge(edge);
    const glm::dvec3 a(mesh.positions()[index(e.vertices[0])]);
    const glm::dvec3 b(mesh.positions()[index(e.vertices[1])]);
    const glm::dvec3 c = opposite_corner_of(mesh, e.faces[0], e);
    const glm::dvec3 d = opposite_corner_of(mesh, e.faces[1], e);
    double largest = 0.0;
    for (const glm::dvec3& p : {a, b, c, d})
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
    // Half a unit in the last place of each coordinate.
    const double move = std::sqrt(3.0) * 0x1p-24 * largest;
    const glm::dvec3 abc = glm::cross(b - a, c - a);
    const double areas = glm::length(abc) + glm::length(glm::cross(b - a, d - a)) +
                         glm::length(glm::cross(c - a, d - a)) +
                         glm::length(glm::cross(c - b, d - b));
    // Six times the volume; the areas are twice those of the triangles.
    return std::abs(glm::dot(abc, d - a)) <= move * areas;
}

EdgeVisibility visibility_of(const Mesh& mesh, EdgeId edge, bool is_crease) noexcept {
    const EdgeClass edge_class = mesh.edge_class(edge);
    if (is_crease || edge_class == EdgeClass::border || edge_class == EdgeClass::nonmanifold)
        return EdgeVisibility::hard;
    const auto& [first, second] = mesh.edge(edge).faces;
    if (!mesh.plane(first).has_normal() || !mesh.plane(second).has_normal())
        return EdgeVisibility::hidden;
    if (!is_flat(mesh, edge)) return EdgeVisibility::silhouette;
    // Faces that are folded together lie in one plane, too.
    return bend_of(mesh, edge) < 0.5 * std::numbers::pi ? EdgeVisibility::hidden
                                                        : EdgeVisibility::silhouette;
}

template <typename Use>
void for_each_edge_in_parallel(const Mesh& mesh, const Use& use) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.edge_count(), k_edges_a_task),
                      [&](const auto& run) {
                          for (std::uint32_t e = run.begin(); e < run.end(); ++e) use(EdgeId{e});
                      });
}

}  // namespace

std::vector<EdgeVisibility> edge_visibility(const Mesh& mesh,
                                            std::span<const std::uint8_t> is_crease) {
    RIMLINE_CHECK(is_crease.size() == mesh.edge_count());
    std::vector<EdgeVisibility> edges(mesh.edge_count());
    for_each_edge_in_parallel(mesh, [&](EdgeId edge) {
        edges[index(edge)] = visibility_of(mesh, edge, is_crease[index(edge)] != 0);
    });
    return edges;
}

std::vector<std::uint8_t> crease_flags(const Mesh& mesh, float min_bend_rad) {
    std::vector<std::uint8_t> flags(mesh.edge_count(), 0);
    for_each_edge_in_parallel(mesh, [&](EdgeId edge) {
        const auto bend = static_cast<float>(bend_of(mesh, edge));
        flags[index(edge)] = bend >= min_bend_rad && bend > 0.0f;
    });
    return flags;
}

std::vector<EdgeVisibility> edge_visibility_of_codes(const Mesh& mesh,
                                                     std::span<const std::uint8_t> codes) {
    RIMLINE_CHECK(codes.size() == mesh.face_count());
    std::vector<EdgeVisibility> edges(mesh.edge_count(), EdgeVisibility::hidden);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (unsigned corner = 0; corner < 3; ++corner) {
            const EdgeId edge = mesh.edges_of(FaceId{f})[corner];
            if (edge == k_no_edge) continue;
            // 2 and 3 are hard.
            const unsigned code = std::min(codes[f] >> (2 * corner) & 3u, 2u);
            edges[index(edge)] = std::max(edges[index(edge)], EdgeVisibility(code));
        }
    return edges;
}

EdgeVisibilityCounts count_classes(std::span<const EdgeVisibility> edges) noexcept {
    EdgeVisibilityCounts counts;
    for (const EdgeVisibility edge : edges)
        ++(edge == EdgeVisibility::hidden       ? counts.hidden
           : edge == EdgeVisibility::silhouette ? counts.silhouette
                                                : counts.hard);
    return counts;
}

}  // namespace rimline
