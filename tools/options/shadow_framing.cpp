#include "tools/options/shadow_framing.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/view_defaults.h"
#include "tools/options/picture_scene.h"

namespace rimline::tools {

namespace {

// Lower suns throw endless shadows.
constexpr double k_min_sine = 0.05;

}  // namespace

Camera frame_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                          const glm::dvec3& ground_up, double aspect) {
    const glm::dvec3 up = glm::normalize(ground_up);
    const glm::dvec3 center = mesh.center();
    double ground = std::numeric_limits<double>::max();
    for (const glm::vec3& position : mesh.positions())
        ground = std::min(ground, glm::dot(glm::dvec3(position) - center, up));
    std::vector<glm::vec3> points(mesh.positions().begin(), mesh.positions().end());
    double radius = mesh.radius();
    for (const Light& light : lights) {
        const glm::dvec3 towards = glm::normalize(light.vector);
        const double sine = glm::dot(towards, up);
        if (!light.directional || sine < k_min_sine) continue;
        for (const glm::vec3& position : mesh.positions()) {
            const glm::dvec3 away = glm::dvec3(position) - center;
            const glm::dvec3 shadow = away - (glm::dot(away, up) - ground) / sine * towards;
            const double distance = glm::length(shadow);
            if (distance > k_framed_shadow_radii * mesh.radius()) continue;
            radius = std::max(radius, distance);
            points.emplace_back(center + shadow);
        }
    }
    const glm::dvec3 towards_viewer = camera.eye - camera.target;
    return rounded_to_float(
        fit_camera(camera, Subject(points, center, radius, mesh.up()), towards_viewer, aspect));
}

}  // namespace rimline::tools
