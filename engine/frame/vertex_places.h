#pragma once

// Where the vertices of a mesh are: whether a point is one of them, in O(1). A table of vertices by the hash of
// their coordinates.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class VertexPlaces {
public:
    /// `mesh` must outlive it. O(vertices); 6 to 8 bytes each.
    explicit VertexPlaces(const Mesh& mesh);

    const Mesh& mesh() const noexcept { return *mesh_; }
    /// Whether a vertex has exactly these coordinates. O(1) expected.
    bool has(const glm::vec3& place) const noexcept;

private:
    std::size_t bucket_of(const glm::vec3& place) const noexcept;

    const Mesh* mesh_;
    std::uint32_t shift_;
    std::vector<std::uint32_t> begins_;    // Bucket b: vertices_[begins_[b] .. begins_[b + 1]).
    std::vector<std::uint32_t> vertices_;  // By bucket.
};

/// A light, in the mesh's own coordinates, that lies on no vertex: `light` itself, or, if it lies exactly on
/// a vertex, a point beside it. That point is moved away from the mesh's center by 2^-16 of the greatest
/// coordinate, a hundred roundings, so that it lies on a definite side of the planes around the vertex.
/// Silhouettes and volumes must use the same point. O(1) expected.
HomogeneousPoint light_off_vertices(const VertexPlaces& vertices, const HomogeneousPoint& light);

}  // namespace rimline
