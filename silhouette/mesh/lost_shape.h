#pragma once

// Whether single precision loses the shape of a mesh far from the origin.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace rimline {

/// The size of what has to keep its shape of a mesh: the median length of its edges, but at most 1/32 of its extent. Of
/// up to 1,024 edges at equal distances in the list, and of those that have a length. 0 if the mesh has no extent.
/// O(positions).
double detail_size(std::span<const glm::vec3> positions,
                   std::span<const std::array<std::uint32_t, 3>> triangles);

/// Whether floats lose the shape of details of this size at this distance from the origin. They are shorter than 8 steps
/// from a float to the next, at some distances than 4: rounding turns them by up to 7 degrees, or 14.
inline bool floats_lose_shape(double detail, double distance) {
    return detail > 0.0 && detail * 0x1p21 < distance;
}

}  // namespace rimline
