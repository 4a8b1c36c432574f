#pragma once

// The triangles of a point's umbrellas, one after another.

#include <cstdint>

#include "silhouette/points/point_surface.h"

namespace rimline {

/// Calls visit(from, to, umbrella) for each triangle of `point`: with two ring points, in the order of the
/// ring.
template <typename Visit>
void for_each_triangle(const PointSurface& surface, PointId point, Visit&& visit) {
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    for (std::uint32_t u = range.first; u < range.last; ++u) {
        const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
        const std::size_t size = umbrella.ring.size();
        for (std::size_t j = 0; j < size; ++j)
            if (!umbrella.is_gap(j))
                visit(umbrella.ring[j], umbrella.ring[j + 1 == size ? 0 : j + 1], UmbrellaId{u});
    }
}

}  // namespace rimline
