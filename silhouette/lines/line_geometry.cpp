#include "silhouette/lines/line_geometry.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/gradual_resize.h"
#include "silhouette/mesh/creases.h"

namespace rimline {

// Shares of the time. Where contacts are searched for, that takes most of it, else the tree.
LineGeometry::LineGeometry(const Mesh& mesh, bool finds_contacts, const LongCall& call)
    : mesh_(mesh),
      stars_(mesh, call.part(0.0, finds_contacts ? 0.03 : 0.08)),
      tree_(mesh, call.part(finds_contacts ? 0.03 : 0.08, finds_contacts ? 0.3 : 0.8)) {
    call.checkpoint(finds_contacts ? 0.3 : 0.8);
    const std::vector<std::uint8_t> is_flat = find_flat_faces(mesh, call.stop);
    if (finds_contacts) contacts_ = find_face_contacts(mesh, tree_, is_flat, call.part(0.3, 0.8));
    call.checkpoint(0.8);
    if (!contacts_.touches.empty()) {
        is_touched_.resize(mesh.vertex_count());
        for (const FaceContacts::Touch& touch : contacts_.touches) is_touched_[touch.vertex] = 1;
    }
    find_slivers(call.stop);
    call.checkpoint(0.85);
    find_special_edges(is_flat);
    call.checkpoint(0.9);
    curves_ = IntersectionCurves(mesh, stars_, tree_, contacts_, is_flat, call.part(0.9, 0.95));
    call.checkpoint(0.95);
    find_bends(call.stop);
    call.checkpoint(1.0);
}

void LineGeometry::find_bends(const std::stop_token& stop) {
    resize_gradually(bends_rad_, mesh_.edge_count(), stop);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh_.edge_count(), 4096),
                      [&](const auto& run) {
                          LongCall{stop, {}}.checkpoint(0.0);
                          for (std::uint32_t e = run.begin(); e < run.end(); ++e)
                              bends_rad_[e] = static_cast<float>(bend_of(mesh_, EdgeId{e}));
                      });
    sharpest_bends_rad_.assign(mesh_.vertex_count(), 0.0f);
    for (std::uint32_t e = 0; e < mesh_.edge_count(); ++e) {
        if (e % (1u << 18) == 0) LongCall{stop, {}}.checkpoint(0.0);
        for (const VertexId vertex : mesh_.edge(EdgeId{e}).vertices) {
            float& sharpest = sharpest_bends_rad_[index(vertex)];
            sharpest = std::max(sharpest, bends_rad_[e]);
        }
    }
}

// A plane comes from a cross product in double, whose terms have rounding errors of 2^-52.
void LineGeometry::find_slivers(const std::stop_token& stop) {
    constexpr double k_min_share = 0x1p-24;
    std::vector<std::uint8_t> is_sliver(mesh_.face_count());
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, mesh_.face_count(), 4096), [&](const auto& run) {
            LongCall{stop, {}}.checkpoint(0.0);
            for (std::uint32_t f = run.begin(); f < run.end(); ++f) {
                const Triangle& t = mesh_.triangles()[f];
                const glm::dvec3 a(mesh_.positions()[index(t[0])]);
                const glm::dvec3 u = glm::dvec3(mesh_.positions()[index(t[1])]) - a;
                const glm::dvec3 v = glm::dvec3(mesh_.positions()[index(t[2])]) - a;
                const glm::dvec3 n = glm::abs(glm::cross(u, v));
                const glm::dvec3 p = glm::abs(u), q = glm::abs(v);
                const double terms =
                    p.y * q.z + p.z * q.y + p.z * q.x + p.x * q.z + p.x * q.y + p.y * q.x;
                is_sliver[f] =
                    n.x + n.y + n.z < k_min_share * terms || !mesh_.plane(FaceId{f}).has_normal();
            }
        });
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
        if (is_sliver[f] != 0) slivers_.push_back(f);
}

void LineGeometry::find_special_edges(std::span<const std::uint8_t> is_flat) {
    const Mesh::EdgeRange nonmanifold = mesh_.edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e)
        special_edges_.push_back(EdgeId{e});
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
        if (is_flat[f] != 0)
            for (const EdgeId edge : mesh_.edges_of(FaceId{f}))
                if (edge != k_no_edge) special_edges_.push_back(edge);
    std::sort(special_edges_.begin(), special_edges_.end());
    special_edges_.erase(std::unique(special_edges_.begin(), special_edges_.end()),
                         special_edges_.end());
}

}  // namespace rimline
