#pragma once

// Colors of lines that follow the materials of a mesh (face_materials.h).

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/face_materials.h"

namespace rimline {

/// Each color of lines costs a draw over the whole picture.
constexpr std::size_t k_max_material_inks = 16;

/// What the faces of each material look like: the mean over its faces of base color, corner colors, and the
/// texture at the middle of the face. Materials that look alike share a color.
struct MaterialInks {
    std::vector<glm::vec3> colors;  ///< In linear light, at most k_max_material_inks.
    /// The index in `colors` for each material. A material without faces has color 0.
    std::vector<std::uint32_t> of_material;
};

/// O(faces + materials).
MaterialInks material_inks(const FaceMaterials& materials);

/// The color of lines on surfaces of this color, in linear light: of its hue, and dark, so that even lines of a
/// white surface stand out on it. `is_light`: pale, for lines on dark paper.
glm::vec3 line_shade(const glm::vec3& surface, bool is_light);

}  // namespace rimline
