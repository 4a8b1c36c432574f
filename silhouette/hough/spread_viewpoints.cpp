#include "silhouette/hough/spread_viewpoints.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "silhouette/error.h"

namespace rimline {

glm::dvec3 spread_direction(std::uint32_t i, std::uint32_t count) {
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(golden_angle * i), across * std::sin(golden_angle * i), z};
}

std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count) {
    const glm::dvec3 c = glm::abs(mesh.center());
    if (std::max({c.x, c.y, c.z}) + 3.0 * mesh.radius() > k_max_coordinate)
        throw Error(ErrorCode::too_large,
                    "coordinates are too large for viewpoints around the model: scale it down");
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.push_back(HomogeneousPoint::viewpoint(
            glm::vec3(mesh.center() + (1.0 + i % 3) * mesh.radius() * spread_direction(i, count))));
    return points;
}

std::vector<HomogeneousPoint> spread_directions(std::uint32_t count) {
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.push_back(HomogeneousPoint::direction(glm::vec3(spread_direction(i, count))));
    return points;
}

}  // namespace rimline
