#pragma once

// Whether a border runs through a point or past it: whichever way bends less.
//
// An inner point next to a border looks much like one of it, where the triangle between it and two border
// points is obtuse; from its own neighbors it cannot tell. The border can. It goes from c over a to b and d,
// or over a, e and b. Compared are the squares of its turns, summed: at a concave corner they are twice as
// much through e, four times where only one of c and d is known, along saw teeth six times; where e stands
// back from a border that is straight or curves gently, ten times and more.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace rimline {

class NeighborLists;
struct OpenPoint;

/// The angle at b between the ways from a and to c, in radians: 0 straight on.
double turn(std::span<const glm::dvec3> points, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The bend of c, a, e, b, d over that of c, a, b, d, to which `min_bend` is added: a straight border's turns
/// are zero but for rounding. c and d where they are known.
double bend_through(std::span<const glm::dvec3> points, std::optional<std::uint32_t> c,
                    std::uint32_t a, std::uint32_t e, std::uint32_t b,
                    std::optional<std::uint32_t> d, double min_bend = 1e-6);

/// Takes points off their borders that stand back from them by ten times the bend, to which that of a turn of
/// eight degrees is added, for noise bends straight borders: they have no gap then, and no verdict, and those
/// on both sides a triangle more, where they are neighbors. `open` is sorted by point.
void straighten_borders(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                        std::vector<OpenPoint>& open);

}  // namespace rimline
