#include "silhouette/lines/exact_signs.h"

#include <doctest/doctest.h>

#include <array>

#include "silhouette/lines/exact_sum.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using Integers = std::array<std::int64_t, 3>;

std::int64_t determinant(const Integers& u, const Integers& v, const Integers& w) {
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
}
Integers minus(const Integers& a, const Integers& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
glm::vec3 as_vector(const Integers& a) { return {float(a[0]), float(a[1]), float(a[2])}; }
int sign(std::int64_t value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

Integers random_point(tests::Random& random, int reach) {
    return {random.between(-reach, reach), random.between(-reach, reach),
            random.between(-reach, reach)};
}

TEST_CASE("sums are exact where doubles lose everything") {
    ExactSum sum;
    sum.add(1e100);
    sum.add(1.0);
    sum.add(-1e100);
    CHECK(sum.sign() == 1);
    sum.add_product(-1.0, 1.0);
    CHECK(sum.sign() == 0);
    sum.add_product(0x1p-600, -0x1p-200);
    CHECK(sum.sign() == -1);
}

TEST_CASE("the side of a plane equals that of integers") {
    constexpr std::uint64_t k_seed = 5;
    CAPTURE(k_seed);
    tests::Random random(k_seed);
    std::size_t zeros = 0;
    for (const int reach : {2, 40, 1'000'000})
        for (int i = 0; i < 20'000; ++i) {
            const Integers a = random_point(random, reach), b = random_point(random, reach),
                           c = random_point(random, reach), p = random_point(random, reach);
            const int expected = sign(determinant(minus(b, a), minus(c, a), minus(p, a)));
            zeros += expected == 0;
            REQUIRE(plane_side(as_vector(a), as_vector(b), as_vector(c), as_vector(p)) == expected);
            REQUIRE(plane_side(as_vector(b), as_vector(a), as_vector(c), as_vector(p)) ==
                    -expected);
        }
    CHECK(zeros > 100);
}

TEST_CASE("a difference of the last bit decides") {
    const float next = 1.0f + 0x1p-23f;
    CHECK(plane_side({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.3f, 0.7f, next}) == 1);
    CHECK(plane_side({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.3f, 0.7f, 1.0f}) == 0);
    CHECK(plane_side({0x1p40f, 0, 0}, {0x1p40f, 1, 0}, {0x1p40f, 0, 1}, {0, 0, 0}) == -1);
}

TEST_CASE("the moved eye sees a side wherever a triangle has an area") {
    constexpr std::uint64_t k_seed = 6;
    CAPTURE(k_seed);
    tests::Random random(k_seed);
    std::size_t ties = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Integers a = random_point(random, 2), b = random_point(random, 2),
                       c = random_point(random, 2), e = random_point(random, 2);
        const bool is_direction = i % 2 == 0;
        const HomogeneousPoint eye = is_direction ? HomogeneousPoint::direction(as_vector(e))
                                                  : HomogeneousPoint::viewpoint(as_vector(e));
        const int side = seen_side(eye, as_vector(a), as_vector(b), as_vector(c));
        const int expected =
            sign(determinant(minus(b, a), minus(c, a), is_direction ? e : minus(e, a)));
        if (expected != 0)
            REQUIRE(side == expected);
        else
            ++ties;
        const Integers u = minus(b, a), v = minus(c, a);
        const bool is_line =
            u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
        REQUIRE((side == 0) == is_line);
        REQUIRE(seen_side(eye, as_vector(c), as_vector(a), as_vector(b)) == side);
        REQUIRE(seen_side(eye, as_vector(b), as_vector(a), as_vector(c)) == -side);
    }
    CHECK(ties > 1000);
}

TEST_CASE("turns in a plane are those of its projection") {
    CHECK(flat_turn(2, {0, 0, 9}, {1, 0, 3}, {0, 1, 5}) == 1);
    CHECK(flat_turn(0, {9, 0, 0}, {3, 1, 0}, {5, 0, 1}) == 1);
    CHECK(flat_turn(1, {0, 9, 0}, {0, 3, 1}, {1, 5, 0}) == 1);
    CHECK(flat_turn(2, {0, 0, 0}, {1, 1, 0}, {2, 2, 1}) == 0);
}

}  // namespace
}  // namespace rimline
