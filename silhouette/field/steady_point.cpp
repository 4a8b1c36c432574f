#include "silhouette/field/steady_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>

#include "silhouette/mesh/any_perpendicular.h"

namespace rimline {

namespace {

constexpr double k_ring_deg = 10.0;  // Between one ring of directions and the next.
constexpr int k_plateau_rings = 2;
constexpr double k_plateau = 0.95;
constexpr double k_gap = 0.8;  // Less of the highest score is a gap between two plateaus.
constexpr int k_max_moves = 10;
constexpr double k_rests_deg = 1.5;

// A point, and rings of 6, 12, 18 ... directions around it, at its distance.
std::vector<glm::dvec3> points_around(const glm::dvec3& point, int rings) {
    const double distance = glm::length(point);
    const glm::dvec3 axis = point / distance;
    const glm::dvec3 x = any_perpendicular(axis);
    const glm::dvec3 y = glm::cross(axis, x);
    std::vector<glm::dvec3> points{point};
    for (int ring = 1; ring <= rings; ++ring) {
        const double away = glm::radians(ring * k_ring_deg);
        for (int i = 0; i < 6 * ring; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / (6.0 * ring);
            const glm::dvec3 side = std::cos(turn) * x + std::sin(turn) * y;
            points.push_back(distance * (std::cos(away) * axis + std::sin(away) * side));
        }
    }
    return points;
}

}  // namespace

double mean_score_near(const glm::dvec3& point, const ScorePoints& score) {
    const std::vector<double> scores = score(points_around(point, 1));
    return std::accumulate(scores.begin(), scores.end(), 0.0) / double(scores.size());
}

glm::dvec3 middle_of_plateau(const glm::dvec3& point, const ScorePoints& score) {
    const double distance = glm::length(point);
    glm::dvec3 middle = point;
    for (int round = 0; round < k_max_moves; ++round) {
        const std::vector<glm::dvec3> points = points_around(middle, k_plateau_rings);
        const std::vector<double> scores = score(points);
        const double highest = std::ranges::max(scores);
        if (highest <= 0.0) break;
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < points.size(); ++i)
            sum += std::max(scores[i] - k_plateau * highest, 0.0) * points[i];
        const glm::dvec3 next = distance * glm::normalize(sum);
        if (score({&next, 1}).front() < k_gap * highest) break;
        const bool rests =
            glm::dot(next, middle) > std::cos(glm::radians(k_rests_deg)) * distance * distance;
        middle = next;
        if (rests) break;
    }
    return middle;
}

bool is_on_plateau(const glm::dvec3& point, const glm::dvec3& middle) {
    return glm::dot(glm::normalize(point), glm::normalize(middle)) >
           std::cos(glm::radians(k_plateau_rings * k_ring_deg));
}

}  // namespace rimline
