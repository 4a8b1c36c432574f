#pragma once

// What shadows need of a mesh besides its silhouettes, made once for each mesh.

#include <map>
#include <optional>

#include "engine/frame/vertex_places.h"
#include "silhouette/mesh/face_tree.h"

namespace rimline {

class CasterMesh {
public:
    /// `mesh` must outlive it. O(vertices).
    explicit CasterMesh(const Mesh& mesh) : vertices_(mesh) {}

    const Mesh& mesh() const noexcept { return vertices_.mesh(); }
    const VertexPlaces& vertices() const noexcept { return vertices_; }
    /// Made by the first call, in O(faces log faces), with up to 28 bytes a face: only a light within the mesh's
    /// bounds needs it.
    const FaceTree& faces() {
        if (!faces_) faces_.emplace(mesh());
        return *faces_;
    }

private:
    VertexPlaces vertices_;
    std::optional<FaceTree> faces_;
};

using CasterMeshes = std::map<const Mesh*, CasterMesh>;

}  // namespace rimline
