#pragma once

// Surfaces made of rings: tubes along a curve, and surfaces of revolution.
//
//     ring 0   ring 1   ring 2          Every ring is closed and has the same number of points.
//        o--------o--------o            The last ring joins the first (a loop), or a fan to a
//       / \      / \      / \           pole closes each end.
//      o---o----o---o----o---o  ...

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

struct TubeGrid {
    std::uint32_t rings;
    std::uint32_t sides;
};

/// A grid of about `quads` nearly square quads. `aspect` is the tube's length divided by its
/// circumference. The grid has at least the rings and sides of `min_grid`.
TubeGrid tube_grid(double quads, double aspect, TubeGrid min_grid) noexcept;

/// The points that close a tube's first and last ring.
struct Poles {
    glm::dvec3 first, last;
};

/// Appends a tube of 2 * rings * sides faces, with or without poles. `point_at(ring, side)` returns
/// its points. Faces point outwards if the sides of a ring are counter-clockwise as seen from
/// beyond the last ring. Needs at least three sides, and three rings in a loop.
void append_tube(MeshSource& shape, TubeGrid grid,
                 const std::function<glm::dvec3(std::uint32_t ring, std::uint32_t side)>& point_at,
                 const std::optional<Poles>& poles = std::nullopt);

}  // namespace rimline
