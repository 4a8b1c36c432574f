#include "tools/output/line_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rimline::tools {

namespace {

constexpr double k_max_tangent = 3.7320508075688772;  // 75 degrees.
constexpr double k_longer_side = 1000.0;
constexpr double k_margin = 20.0;

}  // namespace

LineProjection::LineProjection(const Mesh& mesh, const HomogeneousPoint& point)
    : eye_(point.is_direction() ? mesh.center() : glm::dvec3(point.xyz())),
      is_perspective_(!point.is_direction()) {
    forward_ = is_perspective_ ? mesh.center() - eye_ : -glm::dvec3(point.xyz());
    // At the center itself any direction will do.
    forward_ = glm::length(forward_) > 0.0 ? glm::normalize(forward_) : glm::dvec3(0.0, 0.0, -1.0);
    glm::dvec3 up = direction_of(mesh.up());
    if (glm::length(glm::cross(forward_, up)) < 1e-6)
        up = mesh.up() == UpAxis::z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    right_ = glm::normalize(glm::cross(forward_, up));
    up_ = glm::cross(right_, forward_);
}

glm::dvec3 LineProjection::to_camera(const glm::vec3& p) const noexcept {
    const glm::dvec3 offset = glm::dvec3(p) - eye_;
    return {glm::dot(offset, right_), glm::dot(offset, up_), glm::dot(offset, forward_)};
}

std::optional<PictureLine> LineProjection::project(const glm::vec3& a, const glm::vec3& b) const {
    const glm::dvec3 from = to_camera(a);
    const glm::dvec3 to = to_camera(b);
    if (!is_perspective_) return PictureLine{glm::dvec2(from), glm::dvec2(to)};

    // The pyramid |x| <= t z, |y| <= t z. A point is inside if all four values of its sides are at least 0.
    constexpr double t = k_max_tangent;
    const auto sides = [](const glm::dvec3& p) {
        return std::array{t * p.z - p.x, t * p.z + p.x, t * p.z - p.y, t * p.z + p.y};
    };
    const std::array<double, 4> at_from = sides(from);
    const std::array<double, 4> at_to = sides(to);
    double first = 0.0;
    double last = 1.0;
    for (std::size_t i = 0; i < at_from.size(); ++i) {
        if (at_from[i] < 0.0 && at_to[i] < 0.0) return std::nullopt;
        const double crossing = at_from[i] / (at_from[i] - at_to[i]);
        if (at_from[i] < 0.0) first = std::max(first, crossing);
        if (at_to[i] < 0.0) last = std::min(last, crossing);
    }
    if (first >= last) return std::nullopt;
    const glm::dvec3 p = from + first * (to - from);
    const glm::dvec3 q = from + last * (to - from);
    // The pyramid has no width at its apex: an edge that ends in the viewpoint is projected to a point.
    if (!(p.z > 0.0) || !(q.z > 0.0)) return std::nullopt;
    const PictureLine line{glm::dvec2(p) / p.z, glm::dvec2(q) / q.z};
    return PictureLine{glm::clamp(line.a, -t, t), glm::clamp(line.b, -t, t)};
}

PictureLine PictureFit::to_view(const PictureLine& line) const noexcept {
    const auto mapped = [&](const glm::dvec2& p) {
        return glm::dvec2(margin + scale * (p.x - low.x), height - margin - scale * (p.y - low.y));
    };
    return {mapped(line.a), mapped(line.b)};
}

void PictureFrame::include(const PictureLine& line) noexcept {
    low_ = glm::min(low_, glm::min(line.a, line.b));
    high_ = glm::max(high_, glm::max(line.a, line.b));
}

PictureFit PictureFrame::fit() const noexcept {
    if (!(low_.x <= high_.x)) return {glm::dvec2(0.0), 1.0, 0.0, k_longer_side, k_longer_side};
    const glm::dvec2 extent = high_ - low_;
    const double longer = std::max(extent.x, extent.y);
    const double scale = longer > 0.0 ? (k_longer_side - 2.0 * k_margin) / longer : 1.0;
    return {low_, scale, k_margin, scale * extent.x + 2.0 * k_margin,
            scale * extent.y + 2.0 * k_margin};
}

}  // namespace rimline::tools
