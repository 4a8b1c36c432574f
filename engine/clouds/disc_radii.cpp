#include "engine/clouds/disc_radii.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/umbrella_triangles.h"

namespace rimline {

namespace {

// Limit of a point's radius, in medians over its triangles: a single long triangle must not set it.
constexpr double k_max_medians = 2.0;
// The sine of 25 degrees. A triangle at a larger angle has a disc of its own (disc_pieces.h).
constexpr double k_max_lean = 0.4226;

// Upper median. Reorders `values`. Returns 0 if empty.
double median(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), upper, values.end());
    return *upper;
}

// The radius of three discs at the corners that covers a triangle with these sides from its first corner.
double covering_radius(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths[3] = {glm::length(a), glm::length(b), glm::length(a - b)};
    const double equilateral = *std::max_element(lengths, lengths + 3) * std::numbers::inv_sqrt3;
    const double twice_area = glm::length(glm::cross(a, b));
    if (twice_area == 0.0) return equilateral;
    return std::min(lengths[0] * lengths[1] * lengths[2] / (2.0 * twice_area), equilateral);
}

}  // namespace

std::vector<double> disc_radii(const PointSurface& surface) {
    const std::span<const glm::dvec3> positions = surface.positions();
    std::vector<double> radii(surface.size(), 0.0);
    std::vector<double> known;
    std::vector<double> own;
    for (std::uint32_t p = 0; p < surface.size(); ++p) {
        own.clear();
        for_each_triangle(surface, PointId{p}, [&](PointId a, PointId b, UmbrellaId umbrella) {
            const glm::dvec3 u = positions[index(a)] - positions[p];
            const glm::dvec3 v = positions[index(b)] - positions[p];
            const double lean =
                std::sin(angle_between(glm::cross(u, v), surface.umbrella(umbrella).normal));
            own.push_back(covering_radius(u, v) * (1.0 + std::min(lean, k_max_lean)));
        });
        if (own.empty()) continue;
        const double widest = *std::ranges::max_element(own);
        radii[p] = std::min(widest, k_max_medians * median(own));
        known.push_back(radii[p]);
    }
    const double usual = median(known);
    for (double& radius : radii)
        if (radius == 0.0) radius = usual;
    return radii;
}

}  // namespace rimline
