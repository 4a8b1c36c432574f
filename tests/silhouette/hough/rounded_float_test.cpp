#include "silhouette/hough/rounded_float.h"

#include <doctest/doctest.h>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();

TEST_CASE("a double lies between its rounded floats and no other float does") {
    tests::Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const double value = std::ldexp(double{random.signed_unit()} + 1e-9 * random.signed_unit(),
                                        static_cast<int>(random.below(300)) - 150);
        const float low = rounded_down(value), high = rounded_up(value);
        CAPTURE(value);
        CHECK(double{low} <= value);
        CHECK(double{high} >= value);
        CHECK((low == high || std::nextafter(low, k_infinity) == high));
    }
}

TEST_CASE("floats stay as they are and doubles beyond all floats become infinity") {
    for (const float value : {0.0f, 1.0f, -1.5f, 0x1p-149f, std::numeric_limits<float>::max()}) {
        CHECK(rounded_up(double{value}) == value);
        CHECK(rounded_down(double{value}) == value);
        CHECK(rounded_up(-double{value}) == -value);
    }
    CHECK(rounded_up(1e-60) == 0x1p-149f);
    CHECK(rounded_down(1e-60) == 0.0f);
    CHECK(rounded_up(1e60) == k_infinity);
}

}  // namespace
}  // namespace rimline
