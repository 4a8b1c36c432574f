#pragma once

// The points of a set in an order, and in units, that depend on their coordinates alone. What is computed in
// this order does not depend on the order of the input, and neighbors lie near each other in memory.
//
// Units: the set's bounding box has its center at the origin and its longest side in [1, 2). Coordinates
// are multiples of 2^-50, so their differences are exact, and products of a few do not underflow. Points
// that coincide on that lattice become one. The order is Morton's, then by x, y, z.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

namespace rimline {

struct OrderedPoints {
    std::vector<glm::dvec3> positions;   ///< In units.
    std::vector<std::uint32_t> numbers;  ///< The index of each in the input.
    double unit = 1.0;                   ///< The length of a unit, a power of two.
};

/// `positions` must be finite. Of points that coincide the least by x, y, z is kept. O(n log n) on all threads.
/// Throws Error{cancelled}.
OrderedPoints order_points(std::span<const glm::dvec3> positions, const std::stop_token& stop = {});

}  // namespace rimline
