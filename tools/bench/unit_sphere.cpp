#include "tools/bench/unit_sphere.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rimline::tools {

namespace {

std::vector<HomogeneousPoint> points_on_sphere(const UnitSphere& unit, double radii,
                                               std::uint32_t count) {
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double across = std::sqrt(1.0 - z * z);
        const double angle = golden_angle * i;
        points.push_back(
            unit.viewpoint(radii, {across * std::cos(angle), across * std::sin(angle), z}));
    }
    return points;
}

}  // namespace

HomogeneousPoint UnitSphere::viewpoint(double radii, const glm::dvec3& direction) const {
    return HomogeneousPoint::viewpoint(glm::vec3(center + radii * radius * direction));
}

UnitSphere unit_sphere(const Mesh& mesh) {
    UnitSphere unit;
    for (const glm::vec3& position : mesh.positions()) unit.center += glm::dvec3(position);
    if (mesh.vertex_count() > 0) unit.center /= static_cast<double>(mesh.vertex_count());
    for (const glm::vec3& position : mesh.positions())
        unit.radius = std::max(unit.radius, glm::length(glm::dvec3(position) - unit.center));
    return unit;
}

std::array<std::vector<HomogeneousPoint>, 3> viewpoints_on_spheres(const UnitSphere& unit,
                                                                   std::uint32_t count) {
    std::array<std::vector<HomogeneousPoint>, 3> spheres;
    std::uint32_t area = 0;
    std::uint32_t done = 0;
    for (std::uint32_t radius = 1; radius <= 3; ++radius) {
        area += radius * radius;
        const auto until = static_cast<std::uint32_t>(std::uint64_t{count} * area / (1 + 4 + 9));
        spheres[radius - 1] = points_on_sphere(unit, radius, until - done);
        done = until;
    }
    return spheres;
}

}  // namespace rimline::tools
