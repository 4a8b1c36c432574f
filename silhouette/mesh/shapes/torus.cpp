#include "silhouette/mesh/shapes/circle.h"
#include "silhouette/mesh/shapes/shape_makers.h"
#include "silhouette/mesh/shapes/tube.h"

namespace rimline {

MeshSource make_torus(std::uint32_t faces, double major_radius, double minor_radius) {
    MeshSource torus;
    const TubeGrid grid = tube_grid(0.5 * faces, major_radius / minor_radius, {3, 3});
    append_tube(torus, grid, [&](std::uint32_t ring, std::uint32_t side) {
        const CosSin around = cos_sin_of_turns(double(ring) / grid.rings);
        const CosSin section = cos_sin_of_turns(double(side) / grid.sides);
        const double from_axis = major_radius + minor_radius * section.cos;
        return glm::dvec3(from_axis * around.sin, -minor_radius * section.sin,
                          from_axis * around.cos);
    });
    return torus;
}

}  // namespace rimline
