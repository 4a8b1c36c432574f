#include "silhouette/methods/plane_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/hough/rounded_float.h"

namespace rimline {

PointForm form_of(const HomogeneousPoint& point, const glm::dvec3& origin) noexcept {
    const glm::dvec3 q = glm::dvec3(point.xyz()) - double{point.w} * origin;
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), -point.w};
}

PlaneBounds PlaneBounds::none() noexcept {
    PlaneBounds bounds;
    bounds.low.fill(std::numeric_limits<double>::infinity());
    bounds.high.fill(-std::numeric_limits<double>::infinity());
    return bounds;
}

void PlaneBounds::include(const PlaneBounds& other) noexcept {
    for (std::size_t k = 0; k < low.size(); ++k) {
        low[k] = std::min(low[k], other.low[k]);
        high[k] = std::max(high[k], other.high[k]);
    }
}

[[gnu::always_inline]] inline CertainSides PlaneBoxes::Sides::run(const Group& group,
                                                                  const PointForm& y) {
    CertainSides sides;
    const PointForm size{std::abs(y[0]), std::abs(y[1]), std::abs(y[2]), std::abs(y[3])};
    for (std::uint32_t i = 0; i < k_fan_out; ++i) {
        const float value = (group.center[0][i] * y[0] + group.center[1][i] * y[1]) +
                            (group.center[2][i] * y[2] + group.center[3][i] * y[3]);
        const float reach = (group.extent[0][i] * size[0] + group.extent[1][i] * size[1]) +
                            (group.extent[2][i] * size[2] + group.extent[3][i] * size[3]) +
                            0x1p-140f;
        sides.positive |= value > reach ? 1u << i : 0u;
        sides.negative |= value < -reach ? 1u << i : 0u;
    }
    return sides;
}

PlaneBoxes::PlaneBoxes(const glm::dvec3& origin, std::span<const PlaneBounds> items)
    : tree_(static_cast<std::uint32_t>(items.size())),
      groups_(tree_.group_count()),
      kernel_(best_version<Sides>()) {
    const std::array<double, 3> origin_size{std::abs(origin.x), std::abs(origin.y),
                                            std::abs(origin.z)};
    std::vector<PlaneBounds> below;  // Bounds of the level below.
    for (std::uint32_t level = 0; level < tree_.level_count(); ++level) {
        std::vector<PlaneBounds> nodes(tree_.node_count(level), PlaneBounds::none());
        for (std::uint32_t node = 0; node < nodes.size(); ++node) {
            PlaneBounds& bounds = nodes[node];
            if (level == 0) {
                const PackedTree::Range range = tree_.items_of(0, node);
                for (std::uint32_t i = range.begin; i < range.end; ++i) bounds.include(items[i]);
            } else {
                const std::size_t first = std::size_t{node} * k_fan_out;
                const std::size_t last = std::min(first + k_fan_out, below.size());
                for (std::size_t i = first; i < last; ++i) bounds.include(below[i]);
            }

            Group& group = groups_[tree_.group_of(level, node)];
            const std::uint32_t lane = node % k_fan_out;
            double origin_margin = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                RIMLINE_CHECK(bounds.low[k] >= -0x1p62 && bounds.high[k] <= 0x1p62);
                const auto center = static_cast<float>(0.5 * (bounds.low[k] + bounds.high[k]));
                const double extent = std::max(bounds.high[k] - center, center - bounds.low[k]);
                const double greatest = std::abs(double{center}) + extent;
                group.center[k][lane] = center;
                double stored = extent + 0x1p-20 * greatest;
                if (k < 3)
                    origin_margin += greatest * (0x1p-22 * origin_size[k] + 0x1p-140);
                else
                    stored += origin_margin;
                group.extent[k][lane] = rounded_up(stored);
            }
        }
        below = std::move(nodes);
    }
}

}  // namespace rimline
