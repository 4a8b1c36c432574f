#pragma once

// The materials of the faces of a mesh: the colors that its file gives to surfaces.
//
//     color at a corner of a face = base color of the face's material * color of the corner
//
// Colors are in linear light, each channel in [0, 1]. A face without a material has no color of its own: the
// program that draws the mesh chooses it. Materials belong to faces, and colors to the corners of faces, not
// to vertices. Therefore welding, which joins vertices and keeps faces, changes none of them.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/ids.h"

namespace rimline {

struct SurfaceMaterial {
    glm::vec3 base_color{1.0f};
    bool operator==(const SurfaceMaterial&) const = default;
};

struct FaceMaterials {
    std::vector<SurfaceMaterial> materials;
    /// The index in `materials` for each face, or k_no_material. Empty if no face has a material.
    std::vector<MaterialId> of_face;
    /// Three for each face. Empty if all corners are white.
    std::vector<glm::vec3> corner_colors;

    /// Whether no face has a color.
    bool empty() const noexcept { return of_face.empty(); }
    bool operator==(const FaceMaterials&) const = default;
};

/// Whether the sizes of the lists are those of a mesh of `face_count` faces, and every index is in range.
/// O(faces).
bool are_materials_of(const FaceMaterials& materials, std::size_t face_count) noexcept;

}  // namespace rimline
