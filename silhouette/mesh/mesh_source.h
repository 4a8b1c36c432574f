#pragma once

// The content of a file or the output of a generator, before welding: the input of Mesh.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/face_materials.h"

namespace rimline {

enum class UpAxis : std::uint8_t { y, z };

/// Returns a unit vector.
inline glm::dvec3 direction_of(UpAxis up) noexcept {
    return up == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
}

struct MeshSource {
    /// Numbered as in the file, with unused positions. Each coordinate is finite and within
    /// k_max_coordinate.
    std::vector<glm::vec3> positions;
    /// Counter-clockwise corners as indices into `positions`, with degenerate triangles. Empty for
    /// a file that holds points only.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The up axis of the file format, or y where it has none.
    UpAxis up = UpAxis::y;
    /// Of the faces in `triangles`. Empty if the file gives no face a color.
    FaceMaterials materials = {};
    /// When the edges of each triangle are drawn, if the file says it (edge_visibility.h): two bits each, the edge
    /// from corner 0 to 1 in the lowest. 0: never; 1: on silhouettes, at one of its triangles, and 0 at the other;
    /// 2: always, at one of its triangles, and 3 at the others. Empty, or one for each triangle.
    std::vector<std::uint8_t> edge_codes = {};
    /// What the reader could not use, one sentence each, with the file and the place. It concerns colors
    /// only: a fault of positions or faces is an Error.
    std::vector<std::string> warnings = {};
    /// Whether the format says which axis is up: STL and glTF do. OBJ, PLY and OFF do not.
    bool is_up_known = false;
    /// Files that the model's file refers to: material libraries, textures and buffers of glTF, also those that no
    /// face uses or that could not be read. A program that writes files must not replace them.
    std::vector<std::filesystem::path> files = {};
};

}  // namespace rimline
