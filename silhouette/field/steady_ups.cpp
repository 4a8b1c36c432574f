#include "silhouette/field/steady_ups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/error.h"
#include "silhouette/mesh/any_perpendicular.h"

namespace rimline {

namespace {

constexpr double k_min_turn = 1e-9;     // Of the line of sight, for eyes in the same direction.
constexpr double k_min_weight = 1e-12;  // Below this all eyes are on the axis.

// Rotates `v` by the smallest rotation from unit vector `from` to unit vector `to`.
glm::dvec3 carried(const glm::dvec3& v, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    return v + glm::cross(axis, v) +
           glm::cross(axis, glm::cross(axis, v)) / (1.0 + glm::dot(from, to));
}

// The angle from `reference` to `v` about `n`, in (-π, π]. Both are perpendicular to `n`.
double roll_of(const glm::dvec3& v, const glm::dvec3& reference, const glm::dvec3& n) {
    return std::atan2(glm::dot(glm::cross(reference, v), n), glm::dot(reference, v));
}

// The same angle plus full turns, at most π from `near`.
double unwrapped(double angle, double near) {
    constexpr double k_turn = 2.0 * std::numbers::pi;
    return angle - k_turn * std::round((angle - near) / k_turn);
}

// Solves diagonal[i] x[i] - before[i] x[i-1] - before[i+1] x[i+1] = right[i] with cyclic indices. The
// matrix is diagonally dominant, with three or more rows. Uses Gaussian elimination, and the
// Sherman-Morrison formula for the corner elements.
std::vector<double> solve_around(std::vector<double> diagonal, const std::vector<double>& before,
                                 const std::vector<double>& right) {
    const std::size_t n = diagonal.size();
    const double corner = before[0];
    // Subtracting corner times the outer product of (1, 0, ..., 0, -1) with itself removes the corner
    // elements.
    diagonal[0] -= corner;
    diagonal[n - 1] -= corner;
    std::vector<double> x = right, y(n, 0.0);
    y[0] = 1.0;
    y[n - 1] = -1.0;
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = before[i] / diagonal[i - 1];
        diagonal[i] -= factor * before[i];
        x[i] += factor * x[i - 1];
        y[i] += factor * y[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        if (i + 1 < n) {
            x[i] += before[i + 1] * x[i + 1];
            y[i] += before[i + 1] * y[i + 1];
        }
        x[i] /= diagonal[i];
        y[i] /= diagonal[i];
    }
    const double share = corner * (x[0] - x[n - 1]) / (1.0 + corner * (y[0] - y[n - 1]));
    for (std::size_t i = 0; i < n; ++i) x[i] -= share * y[i];
    return x;
}

}  // namespace

std::vector<glm::dvec3> steady_ups(std::span<const glm::dvec3> eyes, const glm::dvec3& target,
                                   const glm::dvec3& up, double lean_rad) {
    RIMLINE_CHECK(lean_rad > 0.0);
    RIMLINE_CHECK(glm::length(up) > 0.0);
    const std::size_t n = eyes.size();
    if (n == 0) return {};
    const glm::dvec3 axis = glm::normalize(up);
    std::vector<glm::dvec3> backs(n);
    for (std::size_t i = 0; i < n; ++i) {
        RIMLINE_CHECK(eyes[i] != target);
        backs[i] = glm::normalize(eyes[i] - target);
    }

    // The frame without roll, the upright camera's roll relative to it, and its weight.
    std::vector<glm::dvec3> frame(n + 1);
    std::vector<double> upright(n + 1), turn(n), weight(n);
    frame[0] = any_perpendicular(backs[0]);
    for (std::size_t i = 0; i <= n; ++i) {
        const glm::dvec3& back = backs[i % n];
        if (i > 0) {
            const glm::dvec3& last = backs[i - 1];
            RIMLINE_CHECK(glm::dot(last, back) > -1.0 + 1e-12);
            frame[i] = carried(frame[i - 1], last, back);
            turn[i - 1] = std::max(
                k_min_turn, std::atan2(glm::length(glm::cross(last, back)), glm::dot(last, back)));
        }
        const glm::dvec3 across = axis - glm::dot(axis, back) * back;
        const double sine_squared = glm::dot(across, across);
        const double last = i > 0 ? upright[i - 1] : 0.0;
        upright[i] = sine_squared > 0.0 ? unwrapped(roll_of(across, frame[i], back), last) : last;
        if (i < n) weight[i] = sine_squared * sine_squared;
    }
    if (n < 3 || *std::max_element(weight.begin(), weight.end()) < k_min_weight) {
        std::vector<glm::dvec3> ups(n);
        for (std::size_t i = 0; i < n; ++i)
            ups[i] = std::cos(upright[i]) * frame[i] +
                     std::sin(upright[i]) * glm::cross(backs[i], frame[i]);
        return ups;
    }

    // Minimizes the sum over i of stiff[i] (lean[i] - lean[i-1] + change[i])² + pull[i] lean[i]².
    std::vector<double> stiff(n), change(n), diagonal(n), right(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        stiff[i] = lean_rad * lean_rad / turn[before];
        change[i] = upright[before + 1] - upright[before];
    }
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t after = (i + 1) % n;
        const double pull = 0.5 * (turn[(i + n - 1) % n] + turn[i]) * weight[i];
        diagonal[i] = stiff[i] + stiff[after] + pull;
        right[i] = stiff[after] * change[after] - stiff[i] * change[i];
    }
    const std::vector<double> lean = solve_around(std::move(diagonal), stiff, right);
    std::vector<glm::dvec3> ups(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double roll = upright[i] + lean[i];
        ups[i] = std::cos(roll) * frame[i] + std::sin(roll) * glm::cross(backs[i], frame[i]);
    }
    return ups;
}

}  // namespace rimline
