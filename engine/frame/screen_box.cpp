#include "engine/frame/screen_box.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/frame/silhouette_points.h"

namespace rimline {

namespace {

// Relative error of a vector transformed by a float matrix: each product and sum rounds by half of 2^-23;
// with a margin.
constexpr double k_transform_rounding = 4e-7;

}  // namespace

CasterBox caster_box(const SceneInstance& instance) {
    if (!instance.deforming)
        return {glm::dvec3(instance.mesh().bounds().low),
                glm::dvec3(instance.mesh().bounds().high)};
    const BoundingSphere sphere = instance.bounds();
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

void ScreenBox::join(const ScreenBox& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

std::optional<ScreenBox> screen_box(const Camera& camera, const glm::dmat3& eye_from_world,
                                    const Projection& projection, const SceneInstance& instance,
                                    std::span<const glm::dvec3> points,
                                    const glm::dvec2& picture_px) {
    const glm::dvec3 place(glm::vec3(point_in_object(instance, camera.eye)));
    const glm::dmat3 eye_from_object(
        glm::mat3(instance.scale * (eye_from_world * instance.rotation)));
    const double near = camera.is_orthographic() ? 0.0 : projection.z[1];
    ScreenBox rect;
    bool is_before = false;
    bool is_behind = false;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 eye = eye_from_object * (point - place);
        const double w = projection.w[0] * eye.z + projection.w[1];
        const double rounding = k_transform_rounding * instance.scale * glm::length(point - place);
        const double w_rounding = std::abs(projection.w[0]) * rounding;
        if (w + w_rounding <= near) {
            is_behind = true;
            continue;
        }
        if (!(w - w_rounding > near)) return std::nullopt;
        is_before = true;
        const glm::dvec2 ndc = projection.scale * glm::dvec2(eye) / w + projection.shift;
        const glm::dvec2 off =
            (glm::abs(projection.scale) * rounding + glm::abs(ndc) * w_rounding) / w;
        rect.join({(0.5 * (ndc - off) + 0.5) * picture_px, (0.5 * (ndc + off) + 0.5) * picture_px});
    }
    if (is_before && is_behind) return std::nullopt;
    return rect;
}

}  // namespace rimline
