#include "silhouette/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "silhouette/gradual_resize.h"
#include "silhouette/mesh/disjoint_sets.h"
#include "silhouette/mesh/equal_positions.h"

namespace rimline {

namespace {

constexpr std::size_t k_max_faces = std::size_t{1} << 30;
constexpr std::uint32_t k_vertices_a_checkpoint = 1u << 16;
constexpr std::uint32_t k_faces_a_checkpoint = 1u << 16;

// One side of one triangle.
struct HalfEdge {
    std::uint32_t far_vertex;  // The greater of its two vertices. The lesser selects the bucket.
    std::uint32_t face;
    std::uint8_t corner;  // It goes from this corner to the next.
    bool ascending;       // It goes from the lesser vertex to the greater.
};

// Half-edges sorted by lesser vertex, then greater vertex, then face.
struct SortedHalfEdges {
    std::vector<std::uint32_t> begin;  // Indexed by lesser vertex.
    std::vector<HalfEdge> half_edges;
};

bool has_equal_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

SortedHalfEdges sort_half_edges(std::span<const Triangle> triangles, std::uint32_t vertex_count,
                                const LongCall& call) {
    SortedHalfEdges sorted;
    sorted.begin.assign(vertex_count + 1, 0);
    const auto for_each = [&](auto&& visit) {
        for (std::uint32_t f = 0; f < triangles.size(); ++f) {
            if (f % k_faces_a_checkpoint == 0) LongCall{call.stop, {}}.checkpoint(0.0);
            if (has_equal_corners(triangles[f])) continue;
            for (std::uint8_t c = 0; c < 3; ++c)
                visit(f, c, index(triangles[f][c]), index(triangles[f][(c + 1) % 3]));
        }
    };
    for_each([&](std::uint32_t, std::uint8_t, std::uint32_t a, std::uint32_t b) {
        ++sorted.begin[std::min(a, b) + 1];
    });
    std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
    resize_gradually(sorted.half_edges, sorted.begin.back(), call.stop);
    std::vector<std::uint32_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
    call.checkpoint(0.3);
    for_each([&](std::uint32_t f, std::uint8_t c, std::uint32_t a, std::uint32_t b) {
        sorted.half_edges[next[std::min(a, b)]++] = {std::max(a, b), f, c, a < b};
    });
    // Each bucket is sorted by far vertex, then face.
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        if (v % k_vertices_a_checkpoint == 0) call.checkpoint(0.5 + 0.5 * v / vertex_count);
        std::sort(sorted.half_edges.begin() + sorted.begin[v],
                  sorted.half_edges.begin() + sorted.begin[v + 1],
                  [](const HalfEdge& a, const HalfEdge& b) {
                      return a.far_vertex != b.far_vertex ? a.far_vertex < b.far_vertex
                                                          : a.face < b.face;
                  });
    }
    return sorted;
}

EdgeClass classify(std::span<const HalfEdge> sides) {
    if (sides.size() == 1) return EdgeClass::border;
    if (sides.size() > 2) return EdgeClass::nonmanifold;
    return sides[0].ascending == sides[1].ascending ? EdgeClass::inconsistent : EdgeClass::regular;
}

// Visits every edge as (lesser vertex, its half-edges).
template <typename Visit>
void for_each_edge(const SortedHalfEdges& sorted, const LongCall& call, Visit&& visit) {
    const std::span<const HalfEdge> all = sorted.half_edges;
    for (std::uint32_t v = 0; v + 1 < sorted.begin.size(); ++v) {
        if (v % k_vertices_a_checkpoint == 0)
            call.checkpoint(double(v) / static_cast<double>(sorted.begin.size()));
        for (std::size_t i = sorted.begin[v]; i < sorted.begin[v + 1];) {
            std::size_t end = i + 1;
            while (end < sorted.begin[v + 1] && all[end].far_vertex == all[i].far_vertex) ++end;
            visit(v, all.subspan(i, end - i));
            i = end;
        }
    }
}

}  // namespace

Mesh::Mesh(const MeshSource& source, Welding welding, const LongCall& call)
    : welding_(welding),
      up_(source.up),
      is_up_known_(source.is_up_known),
      materials_(source.materials) {
    if (source.triangles.size() > k_max_faces || source.positions.size() > 0xfffffff0u)
        throw Error(ErrorCode::too_large, "the mesh has more than 2^30 triangles or 2^32 vertices");
    RIMLINE_CHECK(are_materials_of(materials_, source.triangles.size()));
    RIMLINE_CHECK(source.edge_codes.empty() || source.edge_codes.size() == source.triangles.size());
    call.checkpoint(0.0);
    weld(source, welding, call.stop);
    call.checkpoint(0.2);
    planes_.reserve(triangles_.size());
    for (const Triangle& t : triangles_) {
        if (planes_.size() % k_faces_a_checkpoint == 0)
            call.checkpoint(0.2 + 0.1 * double(planes_.size()) / double(triangles_.size()));
        // Equal corners give a cross product of exactly zero.
        planes_.push_back(supporting_plane(
            {positions_[index(t[0])], positions_[index(t[1])], positions_[index(t[2])]}));
        if (!planes_.back().has_normal()) ++degenerate_face_count_;
    }
    build_edges(call.part(0.3, 1.0));
    measure();
    call.checkpoint(1.0);
}

void Mesh::weld(const MeshSource& source, Welding welding, const std::stop_token& stop) {
    const auto pause_at = [&](std::size_t i) {
        if (i % k_faces_a_checkpoint == 0) LongCall{stop, {}}.checkpoint(0.0);
    };
    const std::uint32_t source_vertices = size32(source.positions.size());
    file_vertex_count_ = source_vertices;
    for (const glm::vec3& p : source.positions)
        RIMLINE_CHECK(std::abs(p.x) <= k_max_coordinate && std::abs(p.y) <= k_max_coordinate &&
                      std::abs(p.z) <= k_max_coordinate);
    std::vector<std::uint32_t> first;
    if (welding == Welding::equal_positions) {
        first = first_equal_positions<float>(source.positions, stop);
    } else {
        first.resize(source_vertices);
        std::iota(first.begin(), first.end(), 0u);
    }
    constexpr std::uint32_t k_unused = 0xffffffffu;
    std::vector<std::uint32_t> vertex_of(source_vertices, k_unused);
    for (std::size_t f = 0; f < source.triangles.size(); ++f) {
        pause_at(f);
        for (const std::uint32_t corner : source.triangles[f]) {
            RIMLINE_CHECK(corner < source_vertices);
            vertex_of[first[corner]] = 0;
        }
    }
    for (std::uint32_t i = 0; i < source_vertices; ++i) {
        pause_at(i);
        if (vertex_of[i] == k_unused) continue;
        vertex_of[i] = size32(positions_.size());
        positions_.push_back(source.positions[i]);
        file_vertex_.push_back(i);
    }
    triangles_.reserve(source.triangles.size());
    for (const auto& t : source.triangles) {
        pause_at(triangles_.size());
        triangles_.push_back({VertexId{vertex_of[first[t[0]]]}, VertexId{vertex_of[first[t[1]]]},
                              VertexId{vertex_of[first[t[2]]]}});
    }
}

void Mesh::build_edges(const LongCall& call) {
    resize_gradually(face_edges_, triangles_.size(), call.stop, {k_no_edge, k_no_edge, k_no_edge});
    const SortedHalfEdges sorted = sort_half_edges(triangles_, vertex_count(), call.part(0.0, 0.6));

    std::array<std::uint32_t, 4> class_size{};
    std::uint32_t nonmanifold_face_count = 0;
    for_each_edge(sorted, call.part(0.6, 0.7), [&](std::uint32_t, std::span<const HalfEdge> sides) {
        const EdgeClass c = classify(sides);
        ++class_size[static_cast<std::size_t>(c)];
        if (c == EdgeClass::nonmanifold) nonmanifold_face_count += size32(sides.size());
    });
    std::partial_sum(class_size.begin(), class_size.end(), class_begin_.begin() + 1);

    resize_gradually(edges_, class_begin_.back(), call.stop);
    nonmanifold_begin_.reserve(class_size[static_cast<std::size_t>(EdgeClass::nonmanifold)] + 1);
    nonmanifold_begin_.push_back(0);
    nonmanifold_faces_.reserve(nonmanifold_face_count);

    std::uint32_t joined_faces = 0;
    std::uint32_t faces_with_edges = 0;
    for (const Triangle& t : triangles_) faces_with_edges += !has_equal_corners(t);
    DisjointSets sets(triangles_.size());
    bool all_even = true;
    std::array<std::uint32_t, 4> next{class_begin_[0], class_begin_[1], class_begin_[2],
                                      class_begin_[3]};
    for_each_edge(sorted, call.part(0.7, 1.0),
                  [&](std::uint32_t v, std::span<const HalfEdge> sides) {
                      const EdgeClass c = classify(sides);
                      const std::uint32_t e = next[static_cast<std::size_t>(c)]++;
                      const VertexId lesser{v};
                      const VertexId greater{sides[0].far_vertex};
                      edges_[e].vertices = {sides[0].ascending ? lesser : greater,
                                            sides[0].ascending ? greater : lesser};
                      edges_[e].faces = {FaceId{sides[0].face},
                                         sides.size() == 2 ? FaceId{sides[1].face} : k_no_face};
                      for (const HalfEdge& side : sides) {
                          face_edges_[side.face][side.corner] = EdgeId{e};
                          joined_faces += sets.join(sides[0].face, side.face);
                      }
                      if (c == EdgeClass::nonmanifold) {
                          for (const HalfEdge& side : sides)
                              nonmanifold_faces_.push_back(FaceId{side.face});
                          nonmanifold_begin_.push_back(size32(nonmanifold_faces_.size()));
                      }
                      all_even = all_even && sides.size() % 2 == 0;
                  });
    component_count_ = faces_with_edges - joined_faces;
    closed_ = all_even && faces_with_edges > 0;
}

void Mesh::measure() {
    if (positions_.empty()) return;
    bounds_ = {positions_[0], positions_[0]};
    for (const glm::vec3& p : positions_) {
        bounds_.low = glm::min(bounds_.low, p);
        bounds_.high = glm::max(bounds_.high, p);
    }
    for (const glm::vec3& p : positions_)
        radius_ = std::max(radius_, glm::distance(glm::dvec3(p), center()));
}

glm::dvec3 Mesh::center() const noexcept {
    return 0.5 * (glm::dvec3(bounds_.low) + glm::dvec3(bounds_.high));
}

bool Mesh::is_oriented() const noexcept {
    return edges_of_class(EdgeClass::inconsistent).size() == 0;
}

EdgeClass Mesh::edge_class(EdgeId edge) const noexcept {
    const std::uint32_t e = index(edge);
    if (e < class_begin_[1]) return EdgeClass::regular;
    if (e < class_begin_[2]) return EdgeClass::inconsistent;
    return e < class_begin_[3] ? EdgeClass::nonmanifold : EdgeClass::border;
}

std::span<const FaceId> Mesh::faces_of(EdgeId edge) const noexcept {
    switch (edge_class(edge)) {
        case EdgeClass::nonmanifold: {
            const std::uint32_t i = index(edge) - class_begin_[2];
            return std::span(nonmanifold_faces_)
                .subspan(nonmanifold_begin_[i], nonmanifold_begin_[i + 1] - nonmanifold_begin_[i]);
        }
        case EdgeClass::border: return std::span(edges_[index(edge)].faces).first(1);
        default: return edges_[index(edge)].faces;
    }
}

}  // namespace rimline
