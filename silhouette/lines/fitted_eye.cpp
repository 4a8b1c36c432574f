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

std::optional<FittedLens> fit_lens(std::span<const glm::vec3> positions, const glm::dvec3& center,
                                   const glm::dvec3& eye, const glm::dvec3& up, double aspect) {
    // The center of what is seen depends on the direction of the camera. The iteration converges.
    constexpr int k_turns = 8;
    constexpr double k_max_tangent = 5.67;  // Of 80 degrees.
    constexpr double k_min_sine = 0.2;      // Of the angle between the view and up.
    if (positions.empty() || eye == center) return std::nullopt;
    FittedLens lens{center, up, 0.0};
    // Seen along the up axis, the smallest turn would rotate the picture.
    const glm::dvec3 back = glm::normalize(eye - center);
    if (glm::length(glm::cross(back, glm::normalize(up))) < k_min_sine)
        lens.up = LineView::orthographic(eye, center, up).up();
    const double distance = glm::distance(eye, center);
    for (int turn = 0;; ++turn) {
        const LineView axes = LineView::orthographic(eye, lens.target, lens.up);
        glm::dvec2 low(std::numeric_limits<double>::max());
        glm::dvec2 high(-std::numeric_limits<double>::max());
        for (const glm::vec3& position : positions) {
            const glm::dvec3 p = glm::dvec3(position) - eye;
            const double depth = glm::dot(p, axes.forward());
            if (!(depth > 0.0)) return std::nullopt;
            const glm::dvec2 place =
                glm::dvec2(glm::dot(p, axes.right()), glm::dot(p, axes.up())) / depth;
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        const glm::dvec2 reach = glm::max(glm::abs(low), glm::abs(high));
        if (!(reach.x < k_max_tangent && reach.y < k_max_tangent)) return std::nullopt;
        lens.tangent = k_picture_margin * std::max(reach.y, reach.x / aspect);
        if (turn == k_turns) return lens;
        const glm::dvec2 middle = 0.5 * (low + high);
        lens.target =
            eye + distance * (axes.forward() + middle.x * axes.right() + middle.y * axes.up());
    }
}

}  // namespace rimline
