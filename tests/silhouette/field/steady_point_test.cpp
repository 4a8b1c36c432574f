#include "silhouette/field/steady_point.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace rimline {
namespace {

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(
        std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

ScorePoints each(const std::function<double(const glm::dvec3&)>& score) {
    return [score](std::span<const glm::dvec3> points) {
        std::vector<double> scores;
        for (const glm::dvec3& point : points) scores.push_back(score(point));
        return scores;
    };
}

const glm::dvec3 k_top = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
const glm::dvec3 k_aside = glm::normalize(glm::cross(k_top, glm::dvec3(1, 0, 0)));

glm::dvec3 turned(double degrees) {
    const double turn = glm::radians(degrees);
    return std::cos(turn) * k_top + std::sin(turn) * k_aside;
}

// Flat within 15 degrees of k_top.
double plateau(const glm::dvec3& point) {
    return 1.0 - 0.02 * std::max(angle_deg(point, k_top) - 15.0, 0.0);
}

TEST_CASE("the middle of a plateau is found from its edge, at the same distance") {
    for (const double begin_deg : {0.0, 6.0, 14.0, 20.0}) {
        CAPTURE(begin_deg);
        const glm::dvec3 middle = middle_of_plateau(1.9 * turned(begin_deg), each(plateau));
        CHECK(angle_deg(middle, k_top) < 2.0);
        CHECK(glm::length(middle) == doctest::Approx(1.9));
    }
}

TEST_CASE("ripples as high as one percent move the middle of a plateau by few degrees") {
    for (const double phase : {0.0, 1.0, 2.0, 3.0, 4.0}) {
        const auto rippled = [&](const glm::dvec3& p) {
            return plateau(p) + 0.01 * std::sin(31.0 * p.x + phase) * std::cos(27.0 * p.y - phase);
        };
        CHECK(angle_deg(middle_of_plateau(1.9 * turned(12.0), each(rippled)), k_top) < 4.0);
    }
}

TEST_CASE("a spike is higher than a plateau, and its mean is lower") {
    const glm::dvec3 spike = -k_top;
    const auto score = [&](const glm::dvec3& p) {
        return std::max(plateau(p), 1.3 - 0.1 * angle_deg(p, spike));
    };
    CHECK(score(spike) > score(k_top));
    CHECK(mean_score_near(spike, each(score)) < 0.5 * mean_score_near(k_top, each(score)));
    CHECK(mean_score_near(2.0 * k_top, each(plateau)) == doctest::Approx(1.0));
}

TEST_CASE("between two peaks there is no middle") {
    const auto two = [&](const glm::dvec3& p) {
        return 1.0 - 0.05 * std::min(angle_deg(p, turned(0.0)), angle_deg(p, turned(25.0)));
    };
    const glm::dvec3 middle = middle_of_plateau(turned(0.0), each(two));
    CHECK(two(middle) > 0.9);
}

TEST_CASE("where no score is above zero a point stays") {
    const glm::dvec3 point(0.0, 0.0, -1.8);
    CHECK(middle_of_plateau(point, each([](const glm::dvec3&) { return 0.0; })) == point);
}

TEST_CASE("what is within 20 degrees of the middle is on the plateau") {
    CHECK(is_on_plateau(turned(19.0), 2.0 * k_top));
    CHECK_FALSE(is_on_plateau(2.0 * turned(31.0), k_top));
}

}  // namespace
}  // namespace rimline
