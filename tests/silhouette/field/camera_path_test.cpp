// Camera paths against a circle, against what the header promises of any nodes, and against differences
// of places.

#include "silhouette/field/camera_path.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

#include "tests/silhouette/mesh/random.h"

using namespace rimline;
using rimline::tests::Random;

namespace {

constexpr std::uint32_t k_seed = 20061107;
const double k_inner = std::sqrt(3.0);

double between(Random& random, double low, double high) {
    return low + (high - low) * double(random.bits() >> 11) * 0x1p-53;
}

glm::dvec3 random_direction(Random& random) {
    for (;;) {
        const glm::dvec3 v(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        if (const double length = glm::length(v); length > 0.1 && length < 1.0) return v / length;
    }
}

// Nodes in the shell around `center`, no two consecutive ones too near or too far apart.
std::vector<glm::dvec3> random_nodes(Random& random, std::size_t count, const glm::dvec3& center) {
    std::vector<glm::dvec3> nodes;
    const auto fits = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const double cosine = glm::dot(glm::normalize(a - center), glm::normalize(b - center));
        const double angle_deg = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
        return angle_deg > 0.1 && angle_deg < CameraPath::k_max_turn_deg - 0.1;
    };
    while (nodes.size() < count) {
        const glm::dvec3 node = center + between(random, k_inner, 2.0) * random_direction(random);
        if (!nodes.empty() && !fits(nodes.back(), node)) continue;
        if (nodes.size() + 1 == count && !fits(node, nodes.front())) continue;
        nodes.push_back(node);
    }
    return nodes;
}

TEST_CASE("a path through four places on a great circle is that circle at constant speed") {
    const glm::dvec3 center(5, -2, 1);
    std::vector<glm::dvec3> nodes;
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}})
        nodes.push_back(center + 2.0 * axis);
    const CameraPath path(center, nodes);
    CHECK(path.length() == doctest::Approx(4.0 * std::numbers::pi).epsilon(1e-4));
    for (int i = 0; i <= 64; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 64.0;
        const glm::dvec3 expected =
            center + 2.0 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
        CHECK(glm::distance(path.position(i / 64.0), expected) < 1e-3);
    }
}

TEST_CASE("a path passes every node where it says it does and closes") {
    Random random(k_seed);
    for (std::size_t count : {3u, 4u, 8u, 21u}) {
        const glm::dvec3 center = 10.0 * random_direction(random);
        const std::vector<glm::dvec3> nodes = random_nodes(random, count, center);
        const CameraPath path(center, nodes);
        for (std::size_t i = 0; i < count; ++i)
            CHECK(glm::distance(path.position(path.share_of_node(i)), nodes[i]) < 1e-12);
        CHECK(glm::distance(path.position(1.0), nodes[0]) < 1e-12);
        CHECK(glm::distance(path.position(-0.25), path.position(3.75)) < 1e-9);
    }
}

TEST_CASE("no path through random places in the shell leaves it") {
    CAPTURE(k_seed);
    Random random(k_seed);
    for (int trial = 0; trial < 500; ++trial) {
        const CameraPath path(glm::dvec3(0.0), random_nodes(random, 4, glm::dvec3(0.0)));
        double least = 3.0, most = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double distance = glm::length(path.position(i / 2000.0));
            least = std::min(least, distance);
            most = std::max(most, distance);
        }
        CHECK(least >= k_inner - 1e-12);
        CHECK(most <= 2.0 + 1e-12);
    }
}

TEST_CASE("speed is constant and direction continuous on a path through random places") {
    CAPTURE(k_seed);
    Random random(k_seed);
    for (int trial = 0; trial < 100; ++trial) {
        const std::vector<glm::dvec3> nodes = random_nodes(random, 6, glm::dvec3(0.0));
        const CameraPath path(glm::dvec3(0.0), nodes);
        // Across each node: on both sides the same direction and the same speed.
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const double share = path.share_of_node(i);
            constexpr double k_step = 1e-6;
            const glm::dvec3 before = (nodes[i] - path.position(share - k_step)) / k_step;
            const glm::dvec3 after = (path.position(share + k_step) - nodes[i]) / k_step;
            CHECK(glm::distance(before, after) < 0.02 * path.length());
            CHECK(glm::length(before) == doctest::Approx(path.length()).epsilon(0.01));
            CHECK(glm::length(after) == doctest::Approx(path.length()).epsilon(0.01));
        }
        for (int i = 0; i < 200; ++i) {
            const double share = between(random, 0, 1);
            constexpr double k_step = 1e-7;
            const double speed =
                glm::distance(path.position(share), path.position(share + k_step)) / k_step;
            CHECK(speed == doctest::Approx(path.length()).epsilon(0.01));
        }
    }
}

TEST_CASE("a path that comes back the way it went turns round sideways") {
    // Two viewpoints with the same place between them both ways.
    const std::vector<glm::dvec3> nodes = {{2, 0, 0}, {1.3, 1.3, 0.2}, {0, 2, 0}, {1.3, 1.3, 0.2}};
    const CameraPath path(glm::dvec3(0.0), nodes);
    double farthest = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 here = path.position(i / 1000.0);
        REQUIRE(std::isfinite(glm::length(here)));
        CHECK(glm::length(here) >= glm::length(nodes[1]) - 1e-12);
        CHECK(glm::distance(here, path.position((i + 1) / 1000.0)) < 0.0011 * path.length());
        farthest = std::max(farthest, std::abs(here.z));
    }
    CHECK(farthest > 0.2);
    const double share = path.share_of_node(2);
    const glm::dvec3 arriving = glm::normalize(nodes[2] - path.position(share - 1e-6));
    const glm::dvec3 leaving = glm::normalize(path.position(share + 1e-6) - nodes[2]);
    CHECK(glm::dot(arriving, leaving) > 0.9999);
}

}  // namespace
