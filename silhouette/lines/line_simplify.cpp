#include "silhouette/lines/line_simplify.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace rimline {

void simplify(std::span<const LinePoint> points, double tolerance,
              std::vector<std::uint32_t>& kept) {
    kept.clear();
    if (points.empty()) return;
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    kept.push_back(0);
    // Stretches that are still to be done, the next one at the back.
    std::vector<std::array<std::uint32_t, 2>> open;
    if (last > 0) open.push_back({0, last});
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const glm::dvec2 from = points[a].position;
        const glm::dvec2 way = points[b].position - from;
        const double square = glm::dot(way, way);
        double farthest = tolerance;
        std::uint32_t at = a;
        for (std::uint32_t i = a + 1; i < b; ++i) {
            const glm::dvec2 q = points[i].position - from;
            const double share =
                square > 0.0 ? std::clamp(glm::dot(q, way) / square, 0.0, 1.0) : 0.0;
            const double distance = glm::length(q - share * way);
            if (distance > farthest) farthest = distance, at = i;
        }
        if (at == a) {
            kept.push_back(b);
        } else {
            open.push_back({at, b});
            open.push_back({a, at});
        }
    }
}

}  // namespace rimline
