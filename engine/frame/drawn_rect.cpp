#include "engine/frame/drawn_rect.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "engine/frame/scene_data.h"
#include "engine/frame/silhouette_points.h"

namespace rimline {

namespace {

// line.frag reads depth up to 4 pixels from the center of a line; this is twice that.
constexpr double k_look_reach_px = 8.0;
// Relative error of a vector transformed by a float matrix: each product and sum rounds by half of 2^-23;
// with a margin.
constexpr double k_float_rounding = 4e-7;

struct ScreenBox {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

// The rectangle around an instance's box on the screen, in pixels. Empty if the box lies behind the near
// plane; std::nullopt if it lies on both sides of it. Computed as the GPU does, from a camera of floats in
// the box's own coordinates, and widened by the roundings on the way.
std::optional<ScreenBox> screen_box(const FrameView& view, const SceneInstance& instance,
                                    const glm::dvec2& picture) {
    const Projection& projection = view.projection;
    const CasterBox box = caster_box(instance);
    const glm::dvec3 camera(glm::vec3(point_in_object(instance, view.scene.camera.eye)));
    const glm::dmat3 eye_from_object(glm::mat3(view.eye_from_world * instance.rotation));
    const double near = view.scene.camera.is_orthographic() ? 0.0 : projection.z[1];
    ScreenBox rect;
    bool is_before = false;
    bool is_behind = false;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1u) != 0 ? box.high.x : box.low.x,
                               (corner & 2u) != 0 ? box.high.y : box.low.y,
                               (corner & 4u) != 0 ? box.high.z : box.low.z);
        const glm::dvec3 eye = eye_from_object * (point - camera);
        const double w = projection.w[0] * eye.z + projection.w[1];
        const double rounding = k_float_rounding * glm::length(point - camera);
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
        rect.low = glm::min(rect.low, (0.5 * (ndc - off) + 0.5) * picture);
        rect.high = glm::max(rect.high, (0.5 * (ndc + off) + 0.5) * picture);
    }
    if (is_before && is_behind) return std::nullopt;
    return rect;
}

}  // namespace

VkRect2D drawn_rect(const FrameView& view) {
    const Scene& scene = view.scene;
    const glm::dvec2 picture(view.size.width, view.size.height);
    const double reach = k_look_reach_px + 0.5 * std::max(0.0, double(scene.line_width_px));
    ScreenBox all;
    for (const SceneInstance& instance : scene.instances) {
        const std::optional<ScreenBox> box = screen_box(view, instance, picture);
        if (!box) return {{0, 0}, view.size};
        const glm::dvec2 low = box->low - reach;
        const glm::dvec2 high = box->high + reach;
        const bool is_seen = high.x > 0.0 && high.y > 0.0 && low.x < picture.x && low.y < picture.y;
        if (!is_seen) continue;
        all.low = glm::min(all.low, low);
        all.high = glm::max(all.high, high);
    }
    if (!(all.low.x < all.high.x)) return {{0, 0}, {1, 1}};
    const glm::dvec2 low = glm::floor(glm::max(all.low, 0.0));
    const glm::dvec2 high = glm::ceil(glm::min(all.high, picture));
    return {
        {static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y)},
        {static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)}};
}

}  // namespace rimline
