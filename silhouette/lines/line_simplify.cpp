#include "silhouette/lines/line_simplify.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rimline {

namespace {

// Stretches that are divided more often than this lose few points at a time, as those of a comb with equal teeth.
// Lines of real models were divided at most 21 times.
constexpr std::uint32_t k_deep = 64;

struct Stretch {
    std::uint32_t first, last, depth;
};

class Simplifier {
public:
    Simplifier(std::span<const LinePoint> points, double tolerance)
        : points_(points), tolerance_(tolerance) {}

    // The point at which a stretch is divided: the farthest one, or in deep ones that which is nearest to the middle of
    // those half as far. The first point if all are near.
    std::uint32_t division(const Stretch& stretch) const {
        const Line line(points_[stretch.first].position, points_[stretch.last].position);
        double farthest = tolerance_;
        std::uint32_t at = stretch.first;
        for (std::uint32_t i = stretch.first + 1; i < stretch.last; ++i) {
            const double distance = line.distance_to(points_[i].position);
            if (distance > farthest) farthest = distance, at = i;
        }
        if (at == stretch.first || stretch.depth < k_deep) return at;
        const double far = std::max(tolerance_, 0.5 * farthest);
        const std::uint32_t middle = stretch.first + (stretch.last - stretch.first) / 2;
        for (std::uint32_t away = 0;; ++away)
            for (const std::uint32_t i : {middle - away, middle + away})
                if (i > stretch.first && i < stretch.last &&
                    line.distance_to(points_[i].position) > far)
                    return i;
    }

private:
    struct Line {
        Line(const glm::dvec2& from_point, const glm::dvec2& to_point)
            : from(from_point), way(to_point - from_point), square(glm::dot(way, way)) {}
        double distance_to(const glm::dvec2& point) const {
            const glm::dvec2 q = point - from;
            const double share =
                square > 0.0 ? std::clamp(glm::dot(q, way) / square, 0.0, 1.0) : 0.0;
            return glm::length(q - share * way);
        }
        glm::dvec2 from, way;
        double square;
    };

    std::span<const LinePoint> points_;
    double tolerance_;
};

}  // namespace

void simplify(std::span<const LinePoint> points, double tolerance,
              std::vector<std::uint32_t>& kept) {
    kept.clear();
    if (points.empty()) return;
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    kept.push_back(0);
    const Simplifier simplifier(points, tolerance);
    // Stretches that are still to be done, the next one at the back.
    std::vector<Stretch> open;
    if (last > 0) open.push_back({0, last, 0});
    while (!open.empty()) {
        const Stretch stretch = open.back();
        open.pop_back();
        const std::uint32_t at = simplifier.division(stretch);
        if (at == stretch.first) {
            kept.push_back(stretch.last);
        } else {
            open.push_back({at, stretch.last, stretch.depth + 1});
            open.push_back({stretch.first, at, stretch.depth + 1});
        }
    }
}

}  // namespace rimline
