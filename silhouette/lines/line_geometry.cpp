#include "silhouette/lines/line_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace rimline {

namespace {

// Edges that bend by less are drawn by nobody.
constexpr float k_min_bend_rad = 1.0f * std::numbers::pi_v<float> / 180.0f;

}  // namespace

LineGeometry::LineGeometry(const Mesh& mesh, bool finds_contacts, const LongCall& call)
    : mesh_(mesh), stars_(mesh), tree_(mesh) {
    if (finds_contacts) contacts_ = find_face_contacts(mesh, tree_, call.part(0.1, 0.9));
    if (!contacts_.touches.empty()) {
        is_touched_.resize(mesh.vertex_count());
        for (const FaceContacts::Touch& touch : contacts_.touches) is_touched_[touch.vertex] = 1;
    }
    call.checkpoint(0.9);
    find_slivers();
    find_special_edges();
    find_intersections();
    creases_ = find_creases(mesh, k_min_bend_rad);
    call.checkpoint(1.0);
}

// A plane comes from a cross product in double, whose terms have rounding errors of 2^-52.
void LineGeometry::find_slivers() {
    constexpr double k_min_share = 0x1p-24;
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
        const Triangle& t = mesh_.triangles()[f];
        const glm::dvec3 a(mesh_.positions()[index(t[0])]);
        const glm::dvec3 u = glm::dvec3(mesh_.positions()[index(t[1])]) - a;
        const glm::dvec3 v = glm::dvec3(mesh_.positions()[index(t[2])]) - a;
        const glm::dvec3 n = glm::abs(glm::cross(u, v));
        const glm::dvec3 p = glm::abs(u), q = glm::abs(v);
        const double terms = p.y * q.z + p.z * q.y + p.z * q.x + p.x * q.z + p.x * q.y + p.y * q.x;
        if (n.x + n.y + n.z < k_min_share * terms || !mesh_.plane(FaceId{f}).has_normal())
            slivers_.push_back(f);
    }
}

void LineGeometry::find_special_edges() {
    const Mesh::EdgeRange nonmanifold = mesh_.edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e)
        special_edges_.push_back(EdgeId{e});
    const std::vector<std::uint8_t> is_flat = find_flat_faces(mesh_);
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
        if (is_flat[f] != 0)
            for (const EdgeId edge : mesh_.edges_of(FaceId{f}))
                if (edge != k_no_edge) special_edges_.push_back(edge);
    std::sort(special_edges_.begin(), special_edges_.end());
    special_edges_.erase(std::unique(special_edges_.begin(), special_edges_.end()),
                         special_edges_.end());
}

// Two faces that pass through each other do so along a segment between two piercings: of an edge of one by the
// other, or both of edges of one.
void LineGeometry::find_intersections() {
    struct End {
        std::array<std::uint32_t, 2> faces;
        std::uint32_t piercing;
    };
    std::vector<End> ends;
    for (std::uint32_t i = 0; i < contacts_.piercings.size(); ++i) {
        const auto& [edge, face] = contacts_.piercings[i];
        for (const FaceId other : mesh_.faces_of(EdgeId{edge}))
            ends.push_back({{std::min(face, index(other)), std::max(face, index(other))}, i});
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
        return a.faces != b.faces ? a.faces < b.faces : a.piercing < b.piercing;
    });
    const auto position_of = [&](std::uint32_t piercing) {
        const auto& [edge, face] = contacts_.piercings[piercing];
        const auto at = [&](VertexId v) { return glm::dvec3(mesh_.positions()[index(v)]); };
        const Triangle& t = mesh_.triangles()[face];
        const glm::dvec3 a = at(t[0]);
        const glm::dvec3 n = glm::cross(at(t[1]) - a, at(t[2]) - a);
        const glm::dvec3 from = at(mesh_.edge(EdgeId{edge}).vertices[0]);
        const glm::dvec3 way = at(mesh_.edge(EdgeId{edge}).vertices[1]) - from;
        const double share = glm::dot(n, a - from) / glm::dot(n, way);
        return from + std::clamp(share, 0.0, 1.0) * way;
    };
    for (std::size_t i = 0; i + 1 < ends.size();) {
        std::size_t j = i + 1;
        while (j < ends.size() && ends[j].faces == ends[i].faces) ++j;
        if (j - i == 2)
            intersections_.push_back(
                {.ends = {position_of(ends[i].piercing), position_of(ends[i + 1].piercing)},
                 .faces = ends[i].faces,
                 .piercings = {ends[i].piercing, ends[i + 1].piercing}});
        i = j;
    }
}

}  // namespace rimline
