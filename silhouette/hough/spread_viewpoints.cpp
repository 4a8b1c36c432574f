#include "silhouette/hough/spread_viewpoints.h"

#include <cmath>
#include <numbers>

namespace rimline {

namespace {

glm::dvec3 spread_direction(std::uint32_t i, std::uint32_t count) {
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(golden_angle * i), across * std::sin(golden_angle * i), z};
}

}  // namespace

std::vector<HomogeneousPoint> spread_viewpoints(const Mesh& mesh, std::uint32_t count) {
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
