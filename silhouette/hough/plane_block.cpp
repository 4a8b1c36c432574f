#include "silhouette/hough/plane_block.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline {

namespace {

constexpr double k_steps = 16383.0;
constexpr double k_weight_length = 32000.0;
constexpr double k_box_rounding = 22900.0;

}  // namespace

BlockFrame::BlockFrame(const BlockBounds& bounds) noexcept {
    if (bounds.is_empty()) return;
    for (std::size_t i = 0; i < 4; ++i) {
        const double exact = 0.5 * (bounds.low[i] + bounds.high[i]);
        center[i] = static_cast<float>(std::nearbyint(exact / k_center_step) * k_center_step);
        const double middle = double{center[i]};
        extent[i] = std::max(bounds.high[i] - middle, middle - bounds.low[i]);
    }
    const double half_width = *std::max_element(extent.begin(), extent.end());
    // The maximum power of two below k_steps / half_width. half_width is at most about 2.
    while (half_width * double{step_inverse} > k_steps) step_inverse *= 0.5f;
}

void BlockFrame::encode(const PlaneVector& plane, std::uint32_t lane,
                        PlaneBlock& block) const noexcept {
    const auto steps = [&](std::size_t i) {
        const double count = (plane[i] - double{center[i]}) * double{step_inverse};
        // Not lround, which is a call. A branch on the sign would be unpredictable.
        return static_cast<std::int16_t>(count + std::copysign(0.5, count));
    };
    block.normal_xy[2 * lane] = steps(0);
    block.normal_xy[2 * lane + 1] = steps(1);
    block.normal_z_distance[2 * lane] = steps(2);
    block.normal_z_distance[2 * lane + 1] = steps(3);
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
        const double scaled = scale * weights_exact[i];
        weights[i] = static_cast<std::int16_t>(std::lround(scaled));
        residues[i] =
            static_cast<std::int16_t>(std::lround((scaled - weights[i]) / double{k_residue_step}));
    }
    // Limited, to stay finite. Far below the limit blocks decide nothing already.
    spread = static_cast<float>(std::min(scale * 0x3.4p-24 * glm::length(p) + 0.0305, 1e30));
    box_margin = static_cast<std::int32_t>(
        std::min(k_box_rounding + double{spread} / k_center_step, 0x1p30));
}

}  // namespace rimline
