#pragma once

// What shadows need of a mesh besides its silhouettes, made once for each mesh.

#include <map>

#include "engine/frame/face_columns.h"
#include "engine/frame/vertex_places.h"

namespace rimline {

struct CasterMesh {
    /// `mesh` must outlive it. O(faces).
    explicit CasterMesh(const Mesh& mesh) : vertices(mesh), columns(mesh) {}

    VertexPlaces vertices;
    FaceColumns columns;
};

using CasterMeshes = std::map<const Mesh*, CasterMesh>;

}  // namespace rimline
