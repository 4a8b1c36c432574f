#pragma once

// A triangle mesh as silhouettes need it: welded vertices, a plane for each face, and edges sorted
// into four classes by how faces meet there.
//
// Equal positions are one vertex, so that split vertices (UV seams, STL) make no borders, unless it is
// asked otherwise. Vertices that no triangle uses are dropped. Faces keep the file's order, degenerate ones included:
//   a triangle with two equal corners has no plane and contributes no edges;
//   a triangle whose cross product is zero has no plane (its bit is always back) but has edges.
// Built in O(vertices + faces), the same for the same input on every machine.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/mesh_source.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

/// Edges are numbered class by class in this order, within a class by their vertices.
enum class EdgeClass : std::uint8_t {
    regular,       ///< Two faces that run it in opposite directions. Silhouette: bits differ.
    inconsistent,  ///< Two faces that run it the same way. Silhouette: bits are equal.
    nonmanifold,   ///< Three faces or more. Silhouette: bits are not all equal.
    border,        ///< One face. Its own class: always drawn, never joins or leaves a silhouette.
};

/// faces[0], the first of its faces, runs it from vertices[0] to vertices[1]. faces[1] is the second
/// face of a regular or inconsistent edge, else k_no_face; Mesh::faces_of knows them all.
struct Edge {
    std::array<VertexId, 2> vertices;
    std::array<FaceId, 2> faces;
};

using Triangle = std::array<VertexId, 3>;

struct Bounds {
    glm::vec3 low, high;
};

/// Which vertices of a source are one.
enum class Welding : std::uint8_t {
    equal_positions,
    none,  ///< Each index by itself: faces that only touch share nothing.
};

class Mesh {
public:
    /// Throws Error{too_large} beyond 2^30 triangles. A source without triangles gives an empty mesh.
    /// Indices must be in range and coordinates as MeshSource says. Throws Error{cancelled}.
    explicit Mesh(const MeshSource& source, Welding welding = Welding::equal_positions,
                  const LongCall& call = {});

    std::span<const glm::vec3> positions() const noexcept { return positions_; }
    std::span<const Triangle> triangles() const noexcept { return triangles_; }
    std::span<const Plane> planes() const noexcept { return planes_; }
    std::span<const Edge> edges() const noexcept { return edges_; }

    std::uint32_t vertex_count() const noexcept { return size32(positions_.size()); }
    std::uint32_t face_count() const noexcept { return size32(triangles_.size()); }
    std::uint32_t edge_count() const noexcept { return size32(edges_.size()); }

    const Plane& plane(FaceId face) const noexcept { return planes_[index(face)]; }
    const Edge& edge(EdgeId edge) const noexcept { return edges_[index(edge)]; }

    /// The edges of a face: corner 0 to 1, 1 to 2, 2 to 0; k_no_edge three times where two corners
    /// are equal.
    const std::array<EdgeId, 3>& edges_of(FaceId face) const noexcept {
        return face_edges_[index(face)];
    }
    /// All faces of an edge, ascending: one at a border, three or more where non-manifold.
    std::span<const FaceId> faces_of(EdgeId edge) const noexcept;

    EdgeClass edge_class(EdgeId edge) const noexcept;
    /// The ids of a class: edges [first, last).
    struct EdgeRange {
        std::uint32_t first, last;
        std::uint32_t size() const noexcept { return last - first; }
    };
    EdgeRange edges_of_class(EdgeClass edge_class) const noexcept {
        const auto c = static_cast<std::size_t>(edge_class);
        return {class_begin_[c], class_begin_[c + 1]};
    }

    /// The file's number of a vertex: of equal positions that are welded, the first in the file.
    std::uint32_t file_vertex(VertexId vertex) const noexcept {
        return file_vertex_[index(vertex)];
    }
    std::uint32_t file_vertex_count() const noexcept { return file_vertex_count_; }
    std::uint32_t degenerate_face_count() const noexcept { return degenerate_face_count_; }
    /// Sets of faces connected through edges.
    std::uint32_t component_count() const noexcept { return component_count_; }
    /// Every edge has an even number of faces (and there is a face).
    bool is_closed() const noexcept { return closed_; }
    /// No two faces run a shared two-face edge the same way.
    bool is_oriented() const noexcept;
    UpAxis up() const noexcept { return up_; }

    /// Of the used vertices; all zero for an empty mesh.
    const Bounds& bounds() const noexcept { return bounds_; }
    /// The center of the bounds.
    glm::dvec3 center() const noexcept;
    /// The greatest distance from center() to a used vertex.
    double radius() const noexcept { return radius_; }

private:
    static std::uint32_t size32(std::size_t size) noexcept {
        return static_cast<std::uint32_t>(size);
    }
    void weld(const MeshSource& source, Welding welding);
    void build_edges(const LongCall& call);
    void measure();

    std::vector<glm::vec3> positions_;
    std::vector<std::uint32_t> file_vertex_;
    std::vector<Triangle> triangles_;
    std::vector<Plane> planes_;
    std::vector<Edge> edges_;
    std::vector<std::array<EdgeId, 3>> face_edges_;
    // Faces of non-manifold edge i: nonmanifold_faces_[nonmanifold_begin_[i] .. [i + 1]).
    std::vector<std::uint32_t> nonmanifold_begin_;
    std::vector<FaceId> nonmanifold_faces_;
    std::array<std::uint32_t, 5> class_begin_{};

    std::uint32_t file_vertex_count_ = 0;
    std::uint32_t degenerate_face_count_ = 0;
    std::uint32_t component_count_ = 0;
    bool closed_ = false;
    UpAxis up_ = UpAxis::y;
    Bounds bounds_{};
    double radius_ = 0.0;
};

}  // namespace rimline
