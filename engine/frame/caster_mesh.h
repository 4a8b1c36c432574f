#pragma once

// What frames need of a mesh besides its silhouettes, made once for each mesh.

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/frame/bounding_polytope.h"
#include "engine/frame/vertex_places.h"
#include "silhouette/mesh/face_tree.h"

namespace rimline {

class CasterMesh {
public:
    /// `mesh` must outlive it. O(vertices).
    explicit CasterMesh(const Mesh& mesh)
        : vertices_(mesh), polytope_(polytope_around(mesh.positions())) {}

    const Mesh& mesh() const noexcept { return vertices_.mesh(); }
    const VertexPlaces& vertices() const noexcept { return vertices_; }
    /// Corners of a polytope around the mesh.
    std::span<const glm::dvec3> polytope() const noexcept { return polytope_; }
    /// Made by the first call, in O(faces log faces), with up to 28 bytes a face. Needed only where a light is
    /// within the mesh's bounds, or the mesh may be between a light and the camera.
    const FaceTree& faces() {
        if (!faces_) faces_.emplace(mesh());
        return *faces_;
    }

private:
    VertexPlaces vertices_;
    std::vector<glm::dvec3> polytope_;
    std::optional<FaceTree> faces_;
};

using CasterMeshes = std::map<const Mesh*, CasterMesh>;

}  // namespace rimline
