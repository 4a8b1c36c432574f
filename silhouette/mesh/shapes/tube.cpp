#include "silhouette/mesh/shapes/tube.h"

#include <algorithm>
#include <cmath>

#include "silhouette/error.h"

namespace rimline {

TubeGrid tube_grid(double quads, double aspect, TubeGrid min_grid) noexcept {
    const double sides = std::max(std::round(std::sqrt(quads / aspect)), double(min_grid.sides));
    const double rings = std::max(std::round(quads / sides), double(min_grid.rings));
    return {static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(sides)};
}

void append_tube(MeshSource& shape, TubeGrid grid,
                 const std::function<glm::dvec3(std::uint32_t ring, std::uint32_t side)>& point_at,
                 const std::optional<Poles>& poles) {
    const auto [rings, sides] = grid;
    RIMLINE_CHECK(sides >= 3 && rings >= (poles ? 1u : 3u));
    const std::size_t vertices = std::size_t{rings} * sides;
    const auto base = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.reserve(base + vertices + 2);
    shape.triangles.reserve(shape.triangles.size() + 2 * vertices);

    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side)
            shape.positions.push_back(glm::vec3(point_at(ring, side)));
    const auto vertex = [&](std::uint32_t ring, std::uint32_t side) {
        return base + ring % rings * sides + side % sides;
    };
    for (std::uint32_t ring = 0; ring + (poles ? 1 : 0) < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = vertex(ring, side);
            const std::uint32_t b = vertex(ring, side + 1);
            const std::uint32_t c = vertex(ring + 1, side + 1);
            const std::uint32_t d = vertex(ring + 1, side);
            shape.triangles.push_back({a, b, c});
            shape.triangles.push_back({a, c, d});
        }
    if (!poles) return;
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.push_back(glm::vec3(poles->first));
    shape.positions.push_back(glm::vec3(poles->last));
    for (std::uint32_t side = 0; side < sides; ++side) {
        shape.triangles.push_back({first, vertex(0, side + 1), vertex(0, side)});
        shape.triangles.push_back(
            {first + 1, vertex(rings - 1, side), vertex(rings - 1, side + 1)});
    }
}

}  // namespace rimline
