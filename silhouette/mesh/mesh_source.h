#pragma once

// What a file or a generator says, before anything is welded: the input of Mesh.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace rimline {

enum class UpAxis : std::uint8_t { y, z };

/// Of length 1.
inline glm::dvec3 direction_of(UpAxis up) noexcept {
    return up == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
}

struct MeshSource {
    /// In the file's own numbering, unused ones included. Each coordinate finite and within
    /// k_max_coordinate.
    std::vector<glm::vec3> positions;
    /// Counter-clockwise corners as positions' indices; degenerate triangles included. Empty for a
    /// file that holds points only.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The file format's convention.
    UpAxis up = UpAxis::y;
};

}  // namespace rimline
