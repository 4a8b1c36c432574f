#pragma once

// Surfaces made of rings: tubes along a curve, and surfaces of revolution.
//
//     ring 0   ring 1   ring 2          Every ring has the same number of points, closed around.
//        o--------o--------o            The last ring joins the first (a loop), or each end is
//       / \      / \      / \           closed by a fan to a pole.
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

/// The grid of about `quads` nearly square quads for a tube `aspect` times as long as it is around,
/// with no fewer rings and sides than `least`.
TubeGrid tube_grid(double quads, double aspect, TubeGrid least) noexcept;

/// The points that close a tube's first and last ring.
struct Poles {
    glm::dvec3 first, last;
};

/// Appends a tube of 2 * rings * sides faces without poles, 2 * (rings - 1) * sides + 2 * sides
/// with. `point_at(ring, side)` gives its points. Faces look outwards when the sides of a ring run
/// counter-clockwise as seen from beyond the last ring. At least three sides; three rings in a
/// loop.
void append_tube(MeshSource& shape, TubeGrid grid,
                 const std::function<glm::dvec3(std::uint32_t ring, std::uint32_t side)>& point_at,
                 const std::optional<Poles>& poles = std::nullopt);

}  // namespace rimline
