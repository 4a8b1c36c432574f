#include "silhouette/mesh/shapes/circle.h"

#include <doctest/doctest.h>
#include <cmath>
#include <numbers>

namespace rimline {

TEST_CASE("quarter turns are exact") {
    for (int whole = -3; whole <= 3; ++whole) {
        CAPTURE(whole);
        const auto is = [&](double turns, double cos, double sin) {
            const CosSin at = cos_sin_of_turns(whole + turns);
            CHECK(at.cos == cos);
            CHECK(at.sin == sin);
        };
        is(0.0, 1.0, 0.0);
        is(0.25, 0.0, 1.0);
        is(0.5, -1.0, 0.0);
        is(0.75, 0.0, -1.0);
    }
}

TEST_CASE("sine and cosine are those of the standard library but for rounding") {
    for (int i = -20'000; i <= 20'000; ++i) {
        CAPTURE(i);
        const double turns = i / 7919.0;
        const CosSin at = cos_sin_of_turns(turns);
        const long double angle = 2.0L * std::numbers::pi_v<long double> *
                                  (static_cast<long double>(turns) - std::floor(turns));
        REQUIRE(std::abs(at.cos - double(std::cos(angle))) < 0x1p-50);
        REQUIRE(std::abs(at.sin - double(std::sin(angle))) < 0x1p-50);
    }
}

TEST_CASE("just below a whole turn is just below") {
    const CosSin at = cos_sin_of_turns(-0x1p-60);
    CHECK(at.cos == 1.0);
    CHECK(std::abs(at.sin) < 1e-15);
}

}  // namespace rimline
