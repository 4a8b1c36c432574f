#pragma once

// The colors that a reader gave the faces of a file.

#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/face_materials.h"

namespace rimline::tests {

/// The colors at the corners of a face; nothing where it has no material.
inline std::vector<glm::vec3> colors_of(const FaceMaterials& materials, std::size_t face) {
    if (materials.empty() || materials.of_face[face] == k_no_material) return {};
    const glm::vec3 base = materials.materials[index(materials.of_face[face])].base_color;
    std::vector<glm::vec3> colors(3, base);
    if (!materials.corner_colors.empty())
        for (std::size_t c = 0; c < 3; ++c) colors[c] *= materials.corner_colors[3 * face + c];
    return colors;
}

/// One color at all corners of a face.
inline std::vector<glm::vec3> plain(const glm::vec3& color) {
    return std::vector<glm::vec3>(3, color);
}

}  // namespace rimline::tests
