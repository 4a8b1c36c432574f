#include "silhouette/field/steady_ups.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

constexpr double k_lean = 0.15;
const glm::dvec3 k_target(0.3, -0.2, 0.1);
const glm::dvec3 k_up(0.0, 0.0, 2.0);

// Around the target, tilted from the up axis: 0 is about the axis, π/2 passes over both poles.
std::vector<glm::dvec3> tilted_circle(std::size_t count, double tilt_rad) {
    std::vector<glm::dvec3> eyes;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = 2.0 * std::numbers::pi * (double(i) + 0.5) / double(count);
        const glm::dvec3 flat(std::cos(a), std::sin(a), 0.0);
        eyes.push_back(k_target + 3.0 * glm::dvec3(std::cos(tilt_rad) * flat.x, flat.y,
                                                   std::sin(tilt_rad) * flat.x));
    }
    return eyes;
}

glm::dvec3 back_of(const glm::dvec3& eye) { return glm::normalize(eye - k_target); }

glm::dvec3 upright_at(const glm::dvec3& eye) {
    const glm::dvec3 back = back_of(eye);
    return glm::normalize(k_up - glm::dot(k_up, back) * back);
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// What the camera turns about its line of sight from one eye to the next, and what that line turns.
struct Turn {
    double roll, sight;
};
Turn turn_between(const glm::dvec3& eye, const glm::dvec3& up, const glm::dvec3& next_eye,
                  const glm::dvec3& next_up) {
    const glm::dvec3 a = back_of(eye), b = back_of(next_eye);
    const glm::dvec3 n = glm::normalize(glm::cross(a, b));
    // Both frames from the axis about which the line of sight turns, which stays where it is.
    const auto roll = [&](const glm::dvec3& up_, const glm::dvec3& back) {
        return std::atan2(glm::dot(glm::cross(n, up_), back), glm::dot(n, up_));
    };
    return {std::remainder(roll(next_up, b) - roll(up, a), 2.0 * std::numbers::pi), angle(a, b)};
}

double energy(const std::vector<glm::dvec3>& eyes, const std::vector<glm::dvec3>& ups) {
    double sum = 0.0;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const std::size_t next = (i + 1) % eyes.size();
        const std::size_t last = (i + eyes.size() - 1) % eyes.size();
        const Turn turn = turn_between(eyes[i], ups[i], eyes[next], ups[next]);
        const double around = 0.5 * (turn.sight + angle(back_of(eyes[last]), back_of(eyes[i])));
        const double sine = std::sin(angle(back_of(eyes[i]), k_up));
        const double lean = angle(ups[i], upright_at(eyes[i]));
        sum += k_lean * k_lean * turn.roll * turn.roll / turn.sight +
               around * std::pow(sine, 4.0) * lean * lean;
    }
    return sum;
}

double max_roll(const std::vector<glm::dvec3>& eyes, const std::vector<glm::dvec3>& ups) {
    double most = 0.0;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const std::size_t next = (i + 1) % eyes.size();
        const Turn turn = turn_between(eyes[i], ups[i], eyes[next], ups[next]);
        most = std::max(most, std::abs(turn.roll) / turn.sight);
    }
    return most;
}

TEST_CASE("a camera that circles about the up axis stays upright") {
    for (const double height : {-5.0, 0.0, 2.0}) {
        std::vector<glm::dvec3> eyes = tilted_circle(90, 0.0);
        for (glm::dvec3& eye : eyes) eye.z += height;
        const std::vector<glm::dvec3> ups = steady_ups(eyes, k_target, k_up, k_lean);
        REQUIRE(ups.size() == eyes.size());
        for (std::size_t i = 0; i < eyes.size(); ++i)
            CHECK(angle(ups[i], upright_at(eyes[i])) < 1e-9);
    }
}

TEST_CASE("over the poles a camera turns slowly, and stands upright away from them") {
    for (const double tilt : {0.5 * std::numbers::pi, 1.55, 1.5, 1.3}) {
        CAPTURE(tilt);
        const std::vector<glm::dvec3> eyes = tilted_circle(2000, tilt);
        const std::vector<glm::dvec3> ups = steady_ups(eyes, k_target, k_up, k_lean);
        std::vector<glm::dvec3> upright;
        for (const glm::dvec3& eye : eyes) upright.push_back(upright_at(eye));
        CHECK(max_roll(eyes, upright) > 3.4);
        CHECK(max_roll(eyes, ups) < 2.0);
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            CHECK(glm::length(ups[i]) == doctest::Approx(1.0));
            CHECK(std::abs(glm::dot(ups[i], back_of(eyes[i]))) < 1e-9);
            if (std::abs(glm::dot(back_of(eyes[i]), glm::normalize(k_up))) < 0.5)
                CHECK(angle(ups[i], upright[i]) < glm::radians(5.0));
        }
    }
}

TEST_CASE("no other camera near it turns and leans less") {
    tests::Random random(71);
    for (const double tilt : {0.4, 1.2, 1.5}) {
        const std::vector<glm::dvec3> eyes = tilted_circle(200, tilt);
        const std::vector<glm::dvec3> ups = steady_ups(eyes, k_target, k_up, k_lean);
        const double least = energy(eyes, ups);
        for (int round = 0; round < 40; ++round) {
            std::vector<glm::dvec3> others = ups;
            const std::size_t first = random.below(200);
            const std::size_t count = 1 + random.below(200);
            const double lean = 0.02 * (random.below(2) == 0 ? 1.0 : -1.0);
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t i = (first + k) % eyes.size();
                others[i] =
                    std::cos(lean) * ups[i] + std::sin(lean) * glm::cross(back_of(eyes[i]), ups[i]);
            }
            CHECK(energy(eyes, others) > least);
        }
    }
}

TEST_CASE("where the list of eyes begins does not matter") {
    const std::vector<glm::dvec3> eyes = tilted_circle(300, 1.4);
    std::vector<glm::dvec3> later = eyes;
    std::rotate(later.begin(), later.begin() + 77, later.end());
    std::vector<glm::dvec3> ups = steady_ups(eyes, k_target, k_up, k_lean);
    const std::vector<glm::dvec3> later_ups = steady_ups(later, k_target, k_up, k_lean);
    std::rotate(ups.begin(), ups.begin() + 77, ups.end());
    for (std::size_t i = 0; i < ups.size(); ++i) CHECK(angle(ups[i], later_ups[i]) < 1e-9);
}

TEST_CASE("few eyes, equal eyes and eyes on the axis have a frame") {
    CHECK(steady_ups({}, k_target, k_up).empty());
    const glm::dvec3 above = k_target + k_up;
    const std::vector<std::vector<glm::dvec3>> lists{
        {above},
        {above, above, above, above},
        {k_target + glm::dvec3(1, 0, 0)},
        {k_target + glm::dvec3(1, 0, 0), above},
        {above, k_target + glm::dvec3(1, 0, 0), above}};
    for (const std::vector<glm::dvec3>& eyes : lists) {
        const std::vector<glm::dvec3> ups = steady_ups(eyes, k_target, k_up);
        REQUIRE(ups.size() == eyes.size());
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            CHECK(glm::length(ups[i]) == doctest::Approx(1.0));
            CHECK(std::abs(glm::dot(ups[i], back_of(eyes[i]))) < 1e-9);
        }
    }
}

}  // namespace
}  // namespace rimline
