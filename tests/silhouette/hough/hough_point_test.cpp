#include "silhouette/hough/hough_point.h"

#include <doctest/doctest.h>

#include <array>
#include <random>

namespace rimline {
namespace {

using Wide = long double;  // 64 bits of significand at least where the bound is tested.

struct WidePoint {
    std::array<Wide, 3> position;
    Wide distance;
};

WidePoint exact(const Plane& plane, const glm::dvec3& origin) {
    const std::array<Wide, 3> n{plane.nx, plane.ny, plane.nz};
    const Wide distance = Wide{plane.d} - (n[0] * origin.x + n[1] * origin.y + n[2] * origin.z);
    const Wide squares = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    return {{n[0] * distance / squares, n[1] * distance / squares, n[2] * distance / squares},
            distance};
}

Plane random_plane(std::mt19937_64& random, double scale) {
    std::normal_distribution<double> normal;
    std::array<glm::vec3, 3> corners;
    for (glm::vec3& c : corners)
        c = glm::vec3(scale * normal(random), scale * normal(random), scale * normal(random));
    return supporting_plane(corners);
}

TEST_CASE("a Hough point is the foot point of the rounded plane, within its error bound") {
    static_assert(std::numeric_limits<Wide>::digits >= 64);
    const std::uint64_t seed = 51;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    double greatest_share = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double scale = std::exp2(normal(random) * 10.0);
        const Plane plane = random_plane(random, scale);
        if (!plane.has_normal()) continue;
        // Origins in the planes, nearly, and anywhere.
        glm::dvec3 origin(normal(random) * scale, normal(random) * scale, normal(random) * scale);
        if (i % 3 == 0) {
            const glm::dvec3 n(plane.nx, plane.ny, plane.nz);
            origin -= n * ((glm::dot(n, origin) - plane.d) / glm::dot(n, n));
        }
        const HoughPoint h = hough_point(plane, origin);
        const WidePoint e = exact(plane, origin);
        for (int axis = 0; axis < 3; ++axis) {
            const auto off = static_cast<double>(std::abs(e.position[axis] - h.position[axis]));
            REQUIRE(off <= h.error);
            greatest_share = std::max(greatest_share, off / h.error);
        }
        if (h.side != 0) REQUIRE((e.distance > 0) == (h.side > 0));
        if (h.side == 0)
            for (int axis = 0; axis < 3; ++axis) REQUIRE(std::abs(h.position[axis]) <= h.error);
    }
    CHECK(greatest_share > 0.02);  // The bound is of the error's own size.
}

TEST_CASE("a plane through the origin has no side and lies at the origin") {
    const HoughPoint at_zero = hough_point({0.6f, 0.8f, 0.0f, 0.0f}, glm::dvec3(0.0));
    CHECK(at_zero.side == 0);
    CHECK(at_zero.position == glm::dvec3(0.0));
    const HoughPoint at_one = hough_point({0.0f, 1.0f, 0.0f, 2.0f}, glm::dvec3(5.0, 2.0, -7.0));
    CHECK(at_one.side == 0);
    CHECK(at_one.position == glm::dvec3(0.0));
}

TEST_CASE("a plane's side is that of the origin") {
    CHECK(hough_point({0.0f, 1.0f, 0.0f, 2.0f}, glm::dvec3(0.0)).side == 1);
    CHECK(hough_point({0.0f, 1.0f, 0.0f, -2.0f}, glm::dvec3(0.0)).side == -1);
    CHECK(hough_point({0.0f, 1.0f, 0.0f, 2.0f}, glm::dvec3(0.0)).position ==
          glm::dvec3(0.0, 2.0, 0.0));
    CHECK(hough_point({0.0f, -1.0f, 0.0f, -2.0f}, glm::dvec3(0.0)).position ==
          glm::dvec3(0.0, 2.0, 0.0));
}

}  // namespace
}  // namespace rimline
