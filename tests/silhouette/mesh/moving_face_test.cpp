#include "silhouette/mesh/moving_face.h"

#include <doctest/doctest.h>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using Corners = std::array<glm::vec3, 3>;

glm::vec3 times_power_of_two(glm::vec3 v, int exponent) {
    return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}
Corners times_power_of_two(const Corners& corners, int exponent) {
    return {times_power_of_two(corners[0], exponent), times_power_of_two(corners[1], exponent),
            times_power_of_two(corners[2], exponent)};
}

glm::vec3 grid_point(tests::Random& random, int reach) {
    const auto coordinate = [&] { return static_cast<float>(random.between(-reach, reach)); };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

// Twice the volume's sign, in double: exact for small whole coordinates.
double volume(const Corners& corners, const HomogeneousPoint& point) {
    const glm::dvec3 v0(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - v0, glm::dvec3(corners[2]) - v0);
    return glm::dot(normal, glm::dvec3(point.xyz()) - v0 * double(point.w));
}

}  // namespace

TEST_CASE("from corners on a grid the bit is the exact sign, on the plane and at every scale") {
    tests::Random random(11);
    std::uint32_t fronts = 0, in_plane = 0;
    for (int i = 0; i < 200'000; ++i) {
        CAPTURE(i);
        const int reach = i % 3 == 0 ? 4 : 32;
        const Corners corners{grid_point(random, reach), grid_point(random, reach),
                              grid_point(random, reach)};
        const glm::vec3 p = grid_point(random, reach);
        const HomogeneousPoint point =
            i % 2 == 0 ? HomogeneousPoint::viewpoint(p) : HomogeneousPoint::direction(p);
        const double exact = volume(corners, point);
        const bool front = is_front(corners, point);
        REQUIRE(front == (exact > 0.0));
        fronts += front;
        in_plane += exact == 0.0;
        for (const int exponent : {-50, 54}) {
            const glm::vec3 far = times_power_of_two(p, point.is_direction() ? 0 : exponent);
            const HomogeneousPoint there = point.is_direction() ? HomogeneousPoint::direction(far)
                                                                : HomogeneousPoint::viewpoint(far);
            REQUIRE(is_front(times_power_of_two(corners, exponent), there) == front);
        }
    }
    CHECK(fronts > 80'000);
    CHECK(in_plane > 1000);
}

TEST_CASE("from any corners the bit is the sign of the volume wherever that is certain") {
    tests::Random random(12);
    std::uint32_t certain = 0;
    for (int i = 0; i < 200'000; ++i) {
        CAPTURE(i);
        // A third of them slivers, whose cross products nearly cancel.
        const glm::vec3 v0 = random.in_cube(), v1 = random.in_cube();
        const glm::vec3 v2 =
            i % 3 == 0 ? v0 + 0.37f * (v1 - v0) + 1e-6f * random.in_cube() : random.in_cube();
        const Corners corners{v0, v1, v2};
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(2.0f * random.in_cube());
        const glm::dvec3 a = glm::dvec3(v1) - glm::dvec3(v0), b = glm::dvec3(v2) - glm::dvec3(v0);
        const glm::dvec3 q = glm::dvec3(point.xyz()) - glm::dvec3(v0);
        const double exact = volume(corners, point);
        // Each difference is rounded once, 2^-24 of it; the normal's components and the sums, a few
        // times that of a normal that did not cancel more than the triangle is thin.
        const double doubt =
            0x1p-24 *
            (2.0 * glm::length(a) * glm::length(b) + 6.0 * glm::length(glm::cross(a, b))) *
            glm::length(q);
        if (std::abs(exact) <= doubt) continue;
        ++certain;
        REQUIRE(is_front(corners, point) == (exact > 0.0));
    }
    CHECK(certain > 150'000);
}

TEST_CASE("triangles without area are back, however their corners are rounded") {
    tests::Random random(13);
    for (int i = 0; i < 100'000; ++i) {
        CAPTURE(i);
        const glm::vec3 step = grid_point(random, 4000);
        const auto on_line = [&] { return float(random.between(-1000, 1000)) * step; };
        const Corners collinear{on_line(), on_line(), on_line()};
        const glm::vec3 v0 = random.in_cube(), v1 = random.in_cube();
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(2e6f * random.in_cube());
        for (const Corners& corners :
             {collinear, Corners{v0, v0, v1}, Corners{v0, v1, v0}, Corners{v1, v0, v0}})
            REQUIRE_FALSE(is_front(corners, point));
    }
}

TEST_CASE("corners at the ends of the range give one side or the other, never both") {
    tests::Random random(14);
    const float k = k_max_coordinate;
    for (int i = 0; i < 10'000; ++i) {
        CAPTURE(i);
        const auto corner = [&] {
            const int exponent = random.between(-149, 59);
            return random.below(4) == 0 ? glm::vec3(k, -k, random.below(2) ? k : 0.0f)
                                        : times_power_of_two(random.in_cube(), exponent);
        };
        const Corners corners{corner(), corner(), corner()};
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(corner());
        const bool front = is_front(corners, point);
        const bool turned = is_front({corners[0], corners[2], corners[1]}, point);
        REQUIRE_FALSE((front && turned));
    }
    CHECK(is_front({{{k, -k, 0}, {k, k, 0}, {-k, 0, 0}}}, HomogeneousPoint::viewpoint({0, 0, k})));
    CHECK_FALSE(
        is_front({{{k, -k, 0}, {k, k, 0}, {-k, 0, 0}}}, HomogeneousPoint::viewpoint({0, 0, -k})));
}

TEST_CASE("on a shape the bits from corners are those from planes but for the nearest faces") {
    const Mesh mesh(make_built_in_shape("knot", 5000));
    tests::Random random(15);
    std::uint32_t different = 0;
    for (int i = 0; i < 100; ++i) {
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(4.0f * random.in_cube());
        const std::vector<std::uint32_t> words =
            moving_face_bits(mesh.triangles(), mesh.positions(), point);
        REQUIRE(words.size() == face_word_count(mesh.face_count()));
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            different += face_bit(words, FaceId{f}) != is_front(mesh.plane(FaceId{f}), point);
    }
    CHECK(different <= 5);  // Of half a million.
}

}  // namespace rimline
