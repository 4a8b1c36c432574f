#include "silhouette/lines/contact_places.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>

#include "tests/rounds.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

using Vector = glm::i64vec3;

// Small integers as floats. Steps along two axes are tiny, by powers of two: that changes no share, and brings edges that
// meet to angles of any size.
class Grid {
public:
    explicit Grid(tests::Random& random) : random_(random), axis_(random.between(0, 2)) {
        for (double& step : steps_) step = std::exp2(-random.between(0, 45));
    }
    Vector vector(int reach) {
        const auto number = [&] { return random_.between(-reach, reach); };
        const int x = number(), y = number();
        return {x, y, number()};
    }
    int step(int most) { return random_.between(1, most); }
    glm::vec3 point(const Vector& p) const {
        const glm::dvec3 q(double(p.x) * steps_[0], double(p.y) * steps_[1], double(p.z));
        return axis_ == 0 ? glm::vec3(q)
                          : (axis_ == 1 ? glm::vec3(q.y, q.z, q.x) : glm::vec3(q.z, q.x, q.y));
    }

private:
    tests::Random& random_;
    int axis_;
    std::array<double, 2> steps_{};
};

bool are_parallel(const Vector& a, const Vector& b) {
    return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
}

constexpr double k_rounding = 1e-15;

TEST_CASE("edges cross where integers say, however small their angle is") {
    tests::Random random(5);
    int crossings = 0;
    for (int round = 0; round < tests::rounds(20'000); ++round) {
        CAPTURE(round);
        Grid grid(random);
        const Vector at = grid.vector(100), m = grid.vector(50);
        Vector n = grid.vector(50);
        if (round % 2 == 0) n = m + grid.vector(1);
        if (are_parallel(m, n)) continue;
        ++crossings;
        const int before = grid.step(9), after = grid.step(9);
        const int other_before = grid.step(9), other_after = grid.step(9);
        const double share = share_to_crossing(
            grid.point(at - Vector(before) * m), grid.point(at + Vector(after) * m),
            grid.point(at - Vector(other_before) * n), grid.point(at + Vector(other_after) * n));
        CHECK(std::abs(share - double(before) / (before + after)) < k_rounding);
    }
    CHECK(crossings > 1000);
}

TEST_CASE("edges pass planes where integers say, however flat") {
    tests::Random random(6);
    int passages = 0;
    for (int round = 0; round < tests::rounds(20'000); ++round) {
        CAPTURE(round);
        Grid grid(random);
        const Vector at = grid.vector(100), m = grid.vector(20), u = grid.vector(9),
                     v = grid.vector(9);
        const Vector normal(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        if (normal.x * m.x + normal.y * m.y + normal.z * m.z == 0) continue;
        ++passages;
        const int before = grid.step(9), after = grid.step(9);
        const double share =
            share_to_plane(grid.point(at - Vector(before) * m), grid.point(at + Vector(after) * m),
                           grid.point(at + u + v), grid.point(at - Vector(2) * u + v),
                           grid.point(at + Vector(3) * u - Vector(4) * v));
        // Of doubles where they are sure to be that good.
        CHECK(std::abs(share - double(before) / (before + after)) < 1e-6);
    }
    CHECK(passages > 1000);
}

}  // namespace
}  // namespace rimline
