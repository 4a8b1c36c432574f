#include "tools/bench/viewpoints.h"

#include "silhouette/hough/orbit.h"
#include "tools/options/track_path.h"

namespace rimline::tools {

namespace {

constexpr double k_orbit_radius = 2.0;

}  // namespace

std::vector<HomogeneousPoint> half_degree_orbit(const Mesh& mesh, std::uint32_t frames) {
    return orbit_path(mesh, glm::vec3(direction_of(mesh.up())), k_orbit_radius,
                      k_orbit_step_degrees, frames + 1);
}

std::vector<HomogeneousPoint> half_degree_turn(const Mesh& mesh, std::uint32_t frames) {
    const Orbit orbit(glm::dvec3(0.0), direction_of(mesh.up()), 1.0);
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i <= frames; ++i) {
        const double angle_rad = i * k_orbit_step_degrees * std::numbers::pi / 180.0;
        points.push_back(HomogeneousPoint::direction(glm::vec3(orbit.position(angle_rad))));
    }
    return points;
}

}  // namespace rimline::tools
