#include "engine/clouds/disc_radii.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/umbrella_triangles.h"

namespace rimline::tools {

namespace {

constexpr double k_widest = 2.0;  // In medians of a point's triangles.
// Of 25 degrees: what leans more has a disc of its own (disc_pieces.h).
constexpr double k_max_lean = 0.4226;

// The upper one of two. Reorders them; zero for none.
double median(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// What three discs at its corners need to cover a triangle with these sides from its first corner.
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
    std::vector<double> found;
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
        radii[p] = std::min(widest, k_widest * median(own));
        found.push_back(radii[p]);
    }
    const double usual = median(found);
    for (double& radius : radii)
        if (radius == 0.0) radius = usual;
    return radii;
}

}  // namespace rimline::tools
