#include "silhouette/hough/v_sphere.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

HoughBox box_of(glm::dvec3 low, glm::dvec3 high) {
    HoughBox box;
    box.include({low, 0.0, 1});
    box.include({high, 0.0, 1});
    return box;
}

TEST_CASE("a box is inside, outside or across the ball that a viewpoint spans") {
    // An independent formula: nearest and farthest distance from the ball's center.
    const std::uint64_t seed = 61;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<float> normal;
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    std::array<int, 3> seen{};
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 p = 2.0f * vector();
        const glm::vec3 a = vector();
        const glm::vec3 b = a + 0.3f * vector();
        const glm::dvec3 origin(vector());
        const HoughBox box = box_of(glm::min(a, b), glm::max(a, b));
        const glm::dvec3 center = 0.5 * (glm::dvec3(p) - origin);
        const double radius = glm::length(center);
        const glm::dvec3 low(box.low[0], box.low[1], box.low[2]);
        const glm::dvec3 high(box.high[0], box.high[1], box.high[2]);
        const double nearest = glm::distance(glm::clamp(center, low, high), center);
        const double farthest =
            glm::length(glm::max(glm::abs(low - center), glm::abs(high - center)));
        const VSphereSide expected = farthest < radius  ? VSphereSide::inside
                                     : nearest > radius ? VSphereSide::outside
                                                        : VSphereSide::mixed;
        const VSphere sphere(HomogeneousPoint::viewpoint(p), origin, box.reach());
        const VSphereSide side = sphere.side_of(box, box.reach());
        ++seen[static_cast<std::size_t>(side)];
        const bool near_tie = std::min(std::abs(farthest - radius), std::abs(nearest - radius)) <
                              1e-4 * (radius + box.reach());
        REQUIRE((side == expected || (near_tie && side == VSphereSide::mixed)));
    }
    for (const int count : seen) CHECK(count > 1000);
}

TEST_CASE("a direction's v-sphere is the half-space in front of it") {
    const VSphere sphere(HomogeneousPoint::direction({0.0f, 2.0f, 0.0f}), glm::dvec3(7.0), 4.0f);
    const HoughBox above = box_of({-1.0, 0.5, -1.0}, {1.0, 1.0, 1.0});
    const HoughBox below = box_of({-1.0, -1.0, -1.0}, {1.0, -0.5, 1.0});
    const HoughBox across = box_of({-1.0, -0.1, -1.0}, {1.0, 0.1, 1.0});
    CHECK(sphere.side_of(above, above.reach()) == VSphereSide::inside);
    CHECK(sphere.side_of(below, below.reach()) == VSphereSide::outside);
    CHECK(sphere.side_of(across, across.reach()) == VSphereSide::mixed);
}

TEST_CASE("nothing is certain from the origin itself or in no direction") {
    const HoughBox box = box_of({-1.0, 0.5, -1.0}, {1.0, 1.0, 1.0});
    const VSphere none(HomogeneousPoint::direction({0.0f, 0.0f, 0.0f}), glm::dvec3(0.0), 2.0f);
    CHECK(none.side_of(box, box.reach()) == VSphereSide::mixed);
    const VSphere origin(HomogeneousPoint::viewpoint({0.0f, 0.0f, 0.0f}), glm::dvec3(0.0), 2.0f);
    CHECK(origin.side_of(box, box.reach()) == VSphereSide::outside);
}

TEST_CASE("a box holds its points with their errors, rounded outward") {
    HoughBox box;
    CHECK(box.is_empty());
    CHECK(box.reach() == 0.0f);
    box.include(HoughPoint{{0.1, -0.2, 1.0 + 0x1p-40}, 0.0, 1});
    CHECK(double{box.low[0]} <= 0.1);
    CHECK(double{box.high[0]} >= 0.1);
    CHECK(double{box.high[2]} >= 1.0 + 0x1p-40);
    CHECK(box.high[2] - box.low[2] <= 0x1p-22f);
    CHECK(double{box.reach()} >= glm::length(glm::dvec3(0.1, -0.2, 1.0 + 0x1p-40)));
    CHECK(double{box.reach()} <= 1.0001 * glm::length(glm::dvec3(0.1, -0.2, 1.0)));
    box.include(HoughPoint{{0.0, 0.0, 0.0}, 0x1p-60, 0});
    CHECK(box.low[2] <= -0x1p-60f);
}

struct Bits {
    std::uint64_t certain = 0;
    std::uint64_t asked = 0;
    std::uint64_t wrong = 0;
};

// Asks every face's own box which bit it has, and compares with the bit it has.
Bits predicted_bits(const Mesh& mesh, std::uint32_t points, bool with_margin, std::uint64_t seed) {
    const glm::dvec3 origin = mesh.center();
    std::vector<HoughPoint> hough;
    std::vector<HoughBox> boxes;
    float reach = 0.0f;
    for (const Plane& plane : mesh.planes()) {
        hough.push_back(plane.has_normal() ? hough_point(plane, origin) : HoughPoint{{}, 0.0, 0});
        boxes.emplace_back().include(hough.back());
        reach = std::max(reach, boxes.back().reach());
    }
    Bits bits;
    tests::ProbePoints probes(mesh, seed);
    for (std::uint32_t i = 0; i < points; ++i) {
        const HomogeneousPoint p = probes.next();
        const VSphere exact(p, origin, reach);
        const VSphere sphere = with_margin ? exact : exact.without_margin();
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            ++bits.asked;
            const VSphereSide side = sphere.side_of(boxes[f], boxes[f].reach());
            if (side == VSphereSide::mixed || hough[f].side == 0) continue;
            ++bits.certain;
            const bool front = (side == VSphereSide::inside) == (hough[f].side > 0);
            bits.wrong += front != is_front(mesh.plane(FaceId{f}), p);
        }
    }
    return bits;
}

TEST_CASE("what is certain is right, and the margin is what makes it so") {
    const std::uint64_t seed = 62;
    CAPTURE(seed);
    std::uint64_t wrong_without = 0;
    for (const auto& [name, source] : tests::made_meshes(1500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const std::uint32_t points = 300;
        CHECK(predicted_bits(mesh, points, true, seed).wrong == 0);
        wrong_without += predicted_bits(mesh, points, false, seed).wrong;
    }
    CHECK(wrong_without > 0);
}

TEST_CASE("the margin leaves few faces in doubt") {
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const Bits bits = predicted_bits(mesh, 300, true, 63);
    CHECK(bits.certain > bits.asked * 9 / 10);
}

}  // namespace
}  // namespace rimline
