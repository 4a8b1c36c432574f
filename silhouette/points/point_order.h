#pragma once

// The points of a set in an order, and in units, that depend on their coordinates alone: what works on
// them in this order gives the same whatever order they came in, and neighbors lie near in memory.
//
// Units: the set's bounding box has its middle at the origin and its longest side in [1, 2). Coordinates
// are multiples of 2^-50, so differences of them are exact, and no product of a few underflows. Points
// that coincide on that lattice are one. The order is Morton's, then x, y, z.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

struct OrderedPoints {
    std::vector<glm::dvec3> positions;   ///< In units.
    std::vector<std::uint32_t> numbers;  ///< Where each stands in what was given.
    double unit = 1.0;                   ///< The length of a unit, a power of two.
};

/// `positions` must be finite. Of points that coincide the least by x, y, z stays.
OrderedPoints order_points(std::span<const glm::dvec3> positions);

}  // namespace rimline
