#pragma once

// Whether a border goes through a point or past it: the way that bends less.
//
// Where the triangle of an inner point e and two border points a and b is obtuse, the neighbors of e do not
// tell whether e lies on the border. The border itself tells. It goes from c over a and b to d, or from c
// over a, e and b to d. The bend of a way is the sum of the squares of its turns. At a concave corner the
// bend through e is twice the bend past it; four times where only one of c and d is known; along saw teeth
// six times. Where e stands back from a border that is straight or curves gently, it is ten times and more.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace rimline {

class NeighborLists;
struct OpenPoint;

/// The turn at b on the way from a to c, in radians; 0 where the way is straight.
double turn(std::span<const glm::dvec3> points, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The bend of c, a, e, b, d divided by that of c, a, b, d. `min_bend` is added to the divisor, for the turns
/// of a straight border are zero but for rounding. c and d are left out where they are unknown.
double bend_through(std::span<const glm::dvec3> points, std::optional<std::uint32_t> c,
                    std::uint32_t a, std::uint32_t e, std::uint32_t b,
                    std::optional<std::uint32_t> d, double min_bend = 1e-6);

/// Takes points off their borders whose bend is ten times the bend past them. The bend of a turn of eight
/// degrees is added to the latter, for noise bends straight borders. Such a point then has no gap and no
/// verdict. The border points on both sides of it get one more triangle each, where they are neighbors.
/// `open` is sorted by point.
void straighten_borders(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                        std::vector<OpenPoint>& open);

}  // namespace rimline
