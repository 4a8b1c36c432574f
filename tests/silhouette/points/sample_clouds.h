#pragma once

// Points on surfaces whose borders, normals and creases are known.

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

inline constexpr double k_degree = std::numbers::pi / 180.0;

/// In radians, at most a right angle.
inline double angle_of_lines(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), std::abs(glm::dot(a, b)));
}

/// A number in [-1, 1).
inline double jitter(Random& random) { return static_cast<double>(random.signed_unit()); }

/// n x n points of the unit square in z = 0, each inner one moved by up to `amount` of the spacing, those
/// on the outline along it. Point i is on the border where it is on the lattice's outline.
struct Patch {
    std::vector<glm::dvec3> points;
    std::vector<bool> is_border;
};
inline Patch make_patch(std::uint32_t n, double amount, std::uint64_t seed) {
    Random random(seed);
    Patch patch;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const bool on_x = x == 0 || x == n - 1, on_y = y == 0 || y == n - 1;
            const double dx = jitter(random) * amount, dy = jitter(random) * amount;
            patch.points.push_back(
                {(x + (on_x ? 0.0 : dx)) / (n - 1), (y + (on_y ? 0.0 : dy)) / (n - 1), 0.0});
            patch.is_border.push_back(on_x || on_y);
        }
    return patch;
}

/// Evenly spread over the unit sphere, along a spiral (Saff and Kuijlaars 1997).
inline std::vector<glm::dvec3> make_sphere(std::uint32_t count) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    return points;
}

/// Every coordinate moved by nearly normally distributed noise of that standard deviation.
inline void add_noise(std::vector<glm::dvec3>& points, double deviation, std::uint64_t seed) {
    Random random(seed);
    const auto normal = [&] {  // Irwin-Hall: twelve of variance 1/3.
        double sum = 0.0;
        for (int i = 0; i < 12; ++i) sum += jitter(random);
        return sum / 2.0;
    };
    for (glm::dvec3& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] += deviation * normal();
}

}  // namespace rimline::tests
