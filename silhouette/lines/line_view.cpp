#include "silhouette/lines/line_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/error.h"

namespace rimline {

namespace {

// The direction from the eye to point(), in the camera's axes. No ratio of two of them is simple, so the point
// lies on no plane of a machine part.
constexpr glm::dvec3 k_shift_direction{0.6180339887, 0.7548776662, 0.2193};

// Steps of a float by which the point is at least shifted, and the greatest shift for their sake, as a share of the
// distance.
constexpr double k_shift_steps = 4.0;
constexpr double k_max_shift = 0x1p-16;

double largest_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// By a power of two, so that squares are doubles. Changes no bit of the direction.
glm::dvec3 scaled(const glm::dvec3& v) {
    const double largest = largest_of(v);
    if (!(largest > 0.0)) return v;
    const int exponent = -std::ilogb(largest);
    return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

double shift_at(const glm::dvec3& eye, double distance) {
    const double largest = largest_of(eye);
    const double step = largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest) - 23) : 0.0;
    return std::max(LineView::k_shift * distance,
                    std::min(k_shift_steps * step, k_max_shift * distance));
}

}  // namespace

LineView::LineView(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up)
    : eye_(eye), target_(target) {
    RIMLINE_CHECK(eye != target);
    forward_ = glm::normalize(scaled(target - eye));
    glm::dvec3 right = glm::cross(forward_, scaled(up));
    if (!(glm::length(right) > 1e-9 * glm::length(scaled(up))))
        right = glm::cross(forward_,
                           std::abs(forward_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1));
    right_ = glm::normalize(right);
    up_ = glm::cross(right_, forward_);
}

LineView LineView::perspective(const glm::dvec3& eye, const glm::dvec3& target,
                               const glm::dvec3& up, std::optional<double> distance) {
    LineView view(eye, target, up);
    const double shift = view.shift_ = shift_at(eye, distance.value_or(glm::length(target - eye)));
    view.point_ = HomogeneousPoint::viewpoint(glm::vec3(
        eye + shift * (k_shift_direction.x * view.right_ + k_shift_direction.y * view.up_ +
                       k_shift_direction.z * view.forward_)));
    view.point_right_ = view.right_;
    view.point_up_ = view.up_;
    view.point_forward_ = view.forward_;
    return view;
}

LineView LineView::orthographic(const glm::dvec3& eye, const glm::dvec3& target,
                                const glm::dvec3& up) {
    LineView view(eye, target, up);
    view.point_ = HomogeneousPoint::direction(
        glm::vec3(-view.forward_ +
                  k_shift * (k_shift_direction.x * view.right_ + k_shift_direction.y * view.up_)));
    view.point_forward_ = -glm::normalize(glm::dvec3(view.point_.xyz()));
    view.point_right_ = glm::normalize(glm::cross(view.point_forward_, view.up_));
    view.point_up_ = glm::cross(view.point_right_, view.point_forward_);
    return view;
}

LineView::Projected LineView::project(const glm::dvec3& point) const noexcept {
    if (is_orthographic()) {
        const glm::dvec3 q = point - target_;
        return {{glm::dot(q, right_), glm::dot(q, up_)}, glm::dot(q, forward_)};
    }
    const glm::dvec3 q = point - eye_;
    const double depth = glm::dot(q, forward_);
    return {{glm::dot(q, right_) / depth, glm::dot(q, up_) / depth}, depth};
}

glm::dvec3 LineView::unproject(const Projected& projected) const noexcept {
    const auto& [position, depth] = projected;
    if (is_orthographic())
        return target_ + position.x * right_ + position.y * up_ + depth * forward_;
    return eye_ + depth * (position.x * right_ + position.y * up_ + forward_);
}

LineView::Projected LineView::project_from_point(const glm::dvec3& point) const noexcept {
    if (is_orthographic()) {
        const glm::dvec3 q = point - target_;
        return {{glm::dot(q, point_right_), glm::dot(q, point_up_)}, glm::dot(q, point_forward_)};
    }
    const glm::dvec3 q = point - glm::dvec3(point_.xyz());
    const double depth = glm::dot(q, point_forward_);
    return {{glm::dot(q, point_right_) / depth, glm::dot(q, point_up_) / depth}, depth};
}

double drawn_distance(const Mesh& mesh, const glm::dvec3& eye) {
    const double distance = std::max(glm::distance(mesh.center(), eye), mesh.radius());
    return distance > 0.0 ? distance : 1.0;
}

}  // namespace rimline
