#include "tools/view/screen_view.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace rimline::tools {

ScreenView::ScreenView(const Camera& camera, const glm::dvec2& size)
    : camera_(camera), size_(size), axes_(glm::transpose(camera_from_world(camera))) {
    const double half_height = camera.is_orthographic()
                                   ? 0.5 * camera.ortho_height
                                   : std::tan(0.5 * glm::radians(camera.fov_y_deg));
    half_size_ = {half_height * size.x / size.y, half_height};
    if (!camera.projection) return;
    half_size_ = 1.0 / glm::abs(camera.projection->scale);
    shift_ = camera.projection->shift;
}

std::optional<glm::dvec2> ScreenView::pixel_of(const glm::dvec3& world) const {
    const glm::dvec3 from_eye = world - camera_.eye;
    const double depth = -glm::dot(from_eye, axes_[2]);
    const double distance = glm::length(from_eye);
    if (!camera_.is_orthographic() && !(depth > 1e-6 * distance)) return std::nullopt;
    const double scale = camera_.is_orthographic() ? 1.0 : depth;
    const glm::dvec2 across(glm::dot(from_eye, axes_[0]), -glm::dot(from_eye, axes_[1]));
    return (0.5 + 0.5 * (across / (scale * half_size_) + shift_)) * size_;
}

Ray ScreenView::ray_through(const glm::dvec2& pixel) const {
    const glm::dvec2 ndc = 2.0 * pixel / size_ - 1.0 - shift_;
    const glm::dvec3 across = ndc.x * half_size_.x * axes_[0] - ndc.y * half_size_.y * axes_[1];
    if (camera_.is_orthographic()) return {camera_.eye + across, -axes_[2]};
    return {camera_.eye, glm::normalize(across - axes_[2])};
}

glm::dvec3 ScreenView::view_direction() const { return -axes_[2]; }

}  // namespace rimline::tools
