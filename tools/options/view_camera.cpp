#include "tools/options/view_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>

namespace rimline::tools {

double field_of_view_deg(const FittedLens& lens) {
    constexpr double k_min_fov_deg = 0.01;  // Of --fov.
    return std::max(2.0 * glm::degrees(std::atan(lens.tangent)), k_min_fov_deg);
}

ViewCamera camera_of_view(const Mesh& mesh, const glm::dvec3& eye, const glm::dvec3& up,
                          double aspect) {
    ViewCamera camera{rounded_to_float(eye), rounded_to_float(mesh.center()), rounded_to_float(up),
                      90.0};
    const std::optional<FittedLens> lens =
        fit_lens(mesh.positions(), mesh.center(), camera.eye, camera.up, aspect);
    if (!lens) return camera;
    camera.target = rounded_to_float(lens->target);
    camera.up = rounded_to_float(lens->up);
    camera.fov_y_deg = field_of_view_deg(*lens);
    return camera;
}

}  // namespace rimline::tools
