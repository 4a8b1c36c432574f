#include "silhouette/hough/plane_block.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline {

namespace {

constexpr double k_steps = 16383.0;
constexpr double k_weight_length = 32000.0;

}  // namespace

BlockFrame BlockFrame::around(std::span<const PlaneVector> planes) noexcept {
    BlockFrame frame{{}, 0x1p20f};
    if (planes.empty()) return frame;
    PlaneVector low = planes[0];
    PlaneVector high = planes[0];
    for (const PlaneVector& plane : planes.subspan(1)) {
        for (std::size_t i = 0; i < 4; ++i) {
            low[i] = std::min(low[i], plane[i]);
            high[i] = std::max(high[i], plane[i]);
        }
    }
    double half_width = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        frame.center[i] = static_cast<float>(0.5 * (low[i] + high[i]));
        const double center = double{frame.center[i]};
        half_width = std::max({half_width, high[i] - center, center - low[i]});
    }
    // The maximum power of two below k_steps / half_width. half_width is at most about 2.
    while (half_width * double{frame.step_inverse} > k_steps) frame.step_inverse *= 0.5f;
    return frame;
}

std::int32_t BlockFrame::encode(const PlaneVector& plane, std::uint32_t lane,
                                PlaneBlock& block) const noexcept {
    const auto steps = [&](std::size_t i) {
        const double count = (plane[i] - double{center[i]}) * double{step_inverse};
        // Not lround, which is a call. A branch on the sign would be unpredictable.
        return static_cast<std::int16_t>(count + std::copysign(0.5, count));
    };
    const std::array<std::int16_t, 4> k{steps(0), steps(1), steps(2), steps(3)};
    block.normal_xy[2 * lane] = k[0];
    block.normal_xy[2 * lane + 1] = k[1];
    block.normal_z_distance[2 * lane] = k[2];
    block.normal_z_distance[2 * lane + 1] = k[3];
    // At most 4 * 16383 * 16383, which is below 2^31.
    return k[0] * k[0] + k[1] * k[1] + k[2] * k[2] + k[3] * k[3];
}

BlockPoint::BlockPoint(const HomogeneousPoint& point, const glm::dvec3& origin,
                       double length) noexcept {
    const glm::dvec3 p(point.xyz());
    const glm::dvec3 q = p - double{point.w} * origin;
    const PlaneVector weights_exact{q.x, q.y, q.z, -double{point.w} * length};
    double squares = 0.0;
    for (const double weight : weights_exact) squares += weight * weight;
    // From a direction of length zero all weights are zero, and nothing is certain.
    const double scale = squares > 0.0 ? k_weight_length / std::sqrt(squares) : 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        scaled[i] = static_cast<float>(scale * weights_exact[i]);
        weights[i] = static_cast<std::int16_t>(std::lround(scale * weights_exact[i]));
    }
    // Limited, to stay finite. Far below the limit blocks decide nothing already.
    spread = static_cast<float>(std::min(scale * 0x3.4p-24 * glm::length(p) + 0.0305, 1e30));
}

}  // namespace rimline
