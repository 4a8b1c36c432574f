#include "engine/frame/drawn_rect.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace rimline {

namespace {

// line.frag reads depth up to 4 pixels from the center of a line; this is twice that.
constexpr double k_look_reach_px = 8.0;

}  // namespace

VkRect2D drawn_rect(const FrameView& view) {
    const Scene& scene = view.scene;
    const glm::dvec2 picture(view.size.width, view.size.height);
    const double reach = k_look_reach_px + 0.5 * std::max(0.0, double(scene.line_width_px));
    ScreenBox all;
    for (const InstanceView& instance : view.instances) {
        if (!instance.screen) return {{0, 0}, view.size};
        const ScreenBox box{instance.screen->low - reach, instance.screen->high + reach};
        const bool is_seen =
            box.high.x > 0.0 && box.high.y > 0.0 && box.low.x < picture.x && box.low.y < picture.y;
        if (is_seen) all.join(box);
    }
    if (!(all.low.x < all.high.x)) return {{0, 0}, {1, 1}};
    const glm::dvec2 low = glm::floor(glm::max(all.low, 0.0));
    const glm::dvec2 high = glm::ceil(glm::min(all.high, picture));
    return {
        {static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y)},
        {static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)}};
}

}  // namespace rimline
