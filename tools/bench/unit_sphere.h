#pragma once

// The thesis's unit sphere around a mesh, and the viewpoints of its Table 4.2. The text does not define them; we
// choose: the center is the mean of the vertices, the radius the distance from there to the farthest one, and
// viewpoints lie on spheres of one, two and three radii, as dense on each, distributed by the golden angle.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

struct UnitSphere {
    glm::dvec3 center{0.0};
    double radius = 0.0;

    HomogeneousPoint viewpoint(double radii, const glm::dvec3& direction) const;
};
UnitSphere unit_sphere(const Mesh& mesh);

/// `count` viewpoints: those at one, two and three radii are 1, 4 and 9 fourteenths.
std::array<std::vector<HomogeneousPoint>, 3> viewpoints_on_spheres(const UnitSphere& unit,
                                                                   std::uint32_t count);

}  // namespace rimline::tools
