#include "silhouette/lines/fitted_eye.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/lines/line_view.h"

namespace rimline {

FittedEye fit_eye(std::span<const glm::vec3> positions, const glm::dvec3& center, double radius,
                  const glm::dvec3& towards_viewer, const glm::dvec3& up,
                  const glm::dvec2& tangents) {
    if (!(radius > 0.0)) radius = 1.0;
    const glm::dvec3 back = glm::normalize(towards_viewer);
    const LineView axes = LineView::orthographic(center + back * radius, center, up);
    const glm::dvec2 tangent = tangents / k_picture_margin;
    glm::dvec2 high(-std::numeric_limits<double>::max());
    glm::dvec2 low(-std::numeric_limits<double>::max());
    double nearest = 0.0;
    for (const glm::vec3& position : positions) {
        const LineView::Projected p = axes.project(glm::dvec3(position));
        high = glm::max(high, p.position - p.depth * tangent);
        low = glm::max(low, -p.position - p.depth * tangent);
        nearest = std::max(nearest, -p.depth);
    }
    const glm::dvec2 shift = 0.5 * (high - low);
    const glm::dvec2 distance = 0.5 * (high + low) / tangent;
    // The eye lies in front of the positions, also if they are thin and point at the viewer.
    const double back_off = std::max({distance.x, distance.y, nearest + 0.05 * radius});
    const glm::dvec3 target = center + shift.x * axes.right() + shift.y * axes.up();
    return {target + back_off * back, target};
}

}  // namespace rimline
