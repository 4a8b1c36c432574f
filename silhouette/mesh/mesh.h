#pragma once

// A triangle mesh for silhouettes: welded vertices, a plane per face, and edges in four classes by how their
// faces meet.
//
// By default equal positions are one vertex, so that split vertices (UV seams, STL) make no borders.
// Vertices that no triangle uses are dropped. Faces, also degenerate ones, keep the file's order:
//   a triangle with two equal corners has no plane and no edges;
//   a triangle with distinct corners and a zero cross product has no plane, but has edges. Its bit is
//   always back.
// Construction takes O(vertices + faces). The same input gives the same mesh on every machine.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/face_materials.h"
#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/mesh_source.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

/// Edges are numbered by class in this order, and within a class by their vertices.
enum class EdgeClass : std::uint8_t {
    regular,       ///< Two faces that traverse it in opposite directions. Silhouette: bits differ.
    inconsistent,  ///< Two faces that traverse it in the same direction. Silhouette: bits are equal.
    nonmanifold,   ///< Three or more faces. Silhouette: bits are not all equal.
    border,        ///< One face. Always drawn, never part of a silhouette.
};

/// The first face, faces[0], traverses the edge from vertices[0] to vertices[1]. faces[1] is the second face
/// of a regular or inconsistent edge, else k_no_face. Mesh::faces_of returns all faces.
struct Edge {
    std::array<VertexId, 2> vertices;
    std::array<FaceId, 2> faces;
};

using Triangle = std::array<VertexId, 3>;

struct Bounds {
    glm::vec3 low, high;
};

/// Which vertices of a source become one vertex.
enum class Welding : std::uint8_t {
    equal_positions,
    none,  ///< Each index is its own vertex: faces that only touch share none.
};

class Mesh {
public:
    /// Throws Error{too_large} for more than 2^30 triangles, and Error{cancelled}. A source without
    /// triangles gives an empty mesh. Indices must be in range, and coordinates and materials as MeshSource
    /// requires.
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

    /// The edges of a face: corner 0 to 1, 1 to 2, 2 to 0. All three are k_no_edge if two corners are equal.
    const std::array<EdgeId, 3>& edges_of(FaceId face) const noexcept {
        return face_edges_[index(face)];
    }
    /// All faces of an edge, ascending: one for a border, three or more for a non-manifold edge.
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

    /// Whether vertices with equal positions are one.
    bool is_welded() const noexcept { return welding_ == Welding::equal_positions; }
    /// The file's number of a vertex. For welded positions, the first in the file.
    std::uint32_t file_vertex(VertexId vertex) const noexcept {
        return file_vertex_[index(vertex)];
    }
    std::uint32_t file_vertex_count() const noexcept { return file_vertex_count_; }
    std::uint32_t degenerate_face_count() const noexcept { return degenerate_face_count_; }
    /// The number of sets of faces connected by edges.
    std::uint32_t component_count() const noexcept { return component_count_; }
    /// Whether every edge has an even number of faces, and there is an edge.
    bool is_closed() const noexcept { return closed_; }
    /// Whether no edge is inconsistent.
    bool is_oriented() const noexcept;
    /// The source's.
    UpAxis up() const noexcept { return up_; }
    bool is_up_known() const noexcept { return is_up_known_; }
    /// The source's: faces keep their materials.
    const FaceMaterials& materials() const noexcept { return materials_; }

    /// Bounds of the used vertices. All zero for an empty mesh.
    const Bounds& bounds() const noexcept { return bounds_; }
    /// The center of the bounds.
    glm::dvec3 center() const noexcept;
    /// The greatest distance from center() to a used vertex.
    double radius() const noexcept { return radius_; }

private:
    static std::uint32_t size32(std::size_t size) noexcept {
        return static_cast<std::uint32_t>(size);
    }
    void weld(const MeshSource& source, Welding welding, const std::stop_token& stop);
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
    Welding welding_;
    UpAxis up_;
    bool is_up_known_;
    FaceMaterials materials_;
    Bounds bounds_{};
    double radius_ = 0.0;
};

}  // namespace rimline
