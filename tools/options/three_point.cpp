#include "tools/options/three_point.h"

#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "tools/options/view_camera.h"

namespace rimline::tools {

namespace {

// In the key light surfaces have their color. The others make its shadows lighter, so that no tone leaves the range
// of its style.
constexpr float k_fill_share = 0.3f, k_rim_share = 0.5f;

}  // namespace

void add_fill_and_rim(Scene& scene) {
    RIMLINE_CHECK(!scene.lights.empty() && scene.lights.back().directional);
    scene.lights.back().share = 1.0f;
    scene.lights.push_back({.share = k_fill_share, .casts_shadows = false, .fills = true});
    scene.lights.push_back({.share = k_rim_share, .casts_shadows = false, .fills = true});
    move_fill_and_rim(scene);
}

void move_fill_and_rim(Scene& scene) {
    RIMLINE_CHECK(scene.lights.size() >= 3);
    const std::size_t key = scene.lights.size() - 3;
    const glm::dmat3 axes = camera_from_world(scene.camera);
    const glm::dvec3 right(axes[0][0], axes[1][0], axes[2][0]);
    const glm::dvec3 up(axes[0][1], axes[1][1], axes[2][1]);
    const glm::dvec3 back(axes[0][2], axes[1][2], axes[2][2]);
    const double side = glm::dot(scene.lights[key].vector, right) > 0.0 ? -1.0 : 1.0;
    scene.lights[key + 1].vector =
        rounded_to_float(glm::normalize(0.75 * back + 0.65 * side * right + 0.1 * up));
    scene.lights[key + 2].vector =
        rounded_to_float(glm::normalize(-0.6 * back + 0.5 * side * right + 0.65 * up));
}

}  // namespace rimline::tools
