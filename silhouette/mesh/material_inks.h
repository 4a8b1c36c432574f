#pragma once

// Colors of lines that follow the colors of a mesh (face_materials.h).

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/face_materials.h"

namespace rimline {

/// Each color of lines costs a draw over the whole picture.
constexpr std::size_t k_max_material_inks = 16;

constexpr std::uint8_t k_no_material_ink = 0xff;

/// What the faces of a mesh look like: base color times the mean of the corner colors, times the texture at the middle
/// of the face. Faces that look alike share a color. Of more colors than k_max_material_inks, near ones are joined: the
/// group that differs most is split at its mean, until there are so many (after Wan, Wong, Prusinkiewicz, *An Algorithm
/// for Multidimensional Data Clustering*, 1988).
struct MaterialInks {
    std::vector<glm::vec3> colors;  ///< In linear light, at most k_max_material_inks.
    /// The index in `colors` for each face; k_no_material_ink for one without a material. Empty for a mesh without.
    std::vector<std::uint8_t> of_face;
};

/// O(faces + materials).
MaterialInks material_inks(const FaceMaterials& materials);

/// The color of lines on surfaces of this color, in linear light: of its hue, and dark, so that even lines of a
/// white surface stand out on it. `is_light`: pale, for lines on dark paper.
glm::vec3 line_shade(const glm::vec3& surface, bool is_light);

}  // namespace rimline
