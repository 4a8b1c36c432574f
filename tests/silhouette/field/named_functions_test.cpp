#include "silhouette/field/named_functions.h"

#include <doctest/doctest.h>

#include <cmath>

namespace rimline {
namespace {

double smooth(double x) { return x <= 0.0 ? 0.0 : (x >= 1.0 ? 1.0 : 3 * x * x - 2 * x * x * x); }

TEST_CASE("the functions of the applications are their formulas") {
    for (const double alpha : {0.5, 1.0, 1.72}) {
        const TangentialFunction origins = origin_function(alpha);
        const TangentialFunction views = view_function(alpha, 2.0 * alpha);
        const TangentialFunction near = view_function(alpha, alpha);
        const TangentialFunction light = light_function(alpha);
        for (double s = -4.0; s <= 4.0; s += 0.01) {
            const double x = std::abs(s) / alpha;
            CHECK(origins.value(s) ==
                  doctest::Approx(x < 0.5 ? smooth(2.0 * x) : 1.0 - smooth(2.0 * x - 1.0)));
            const double share = s > 0.0 ? 1.0 : 0.25;
            CHECK(views.value(s) ==
                  doctest::Approx((1.0 - smooth(2.0 * x)) + share * smooth((x - 0.5) / 1.5)));
            CHECK(near.value(s) ==
                  doctest::Approx((1.0 - smooth(2.0 * x)) + share * smooth((x - 0.5) / 0.5)));
            const double lit = smooth(2.0 * x) - 2.0 / 3.0 * smooth(2.0 * x - 1.0);
            CHECK(light.value(s) == doctest::Approx(s < 0.0 ? 0.0 : lit));
        }
    }
}

TEST_CASE("named functions are found by their names and stay within 0 and 1") {
    for (const NamedFunction& named : named_functions()) {
        CAPTURE(named.name);
        CHECK(find_named_function(named.name) == &named);
        CHECK(named.function.min_value() >= -1e-15);
        CHECK(named.function.max_value() == doctest::Approx(1.0));
    }
    CHECK(find_named_function("no such") == nullptr);
}

TEST_CASE("the viewing angles in front sum to 1") {
    const TangentialFunction sum =
        small_viewing_angle(2.0) + moderate_viewing_angle(2.0) + large_viewing_angle(2.0);
    for (double s = 0.0; s < 3.0; s += 0.01) CHECK(sum.value(s) == doctest::Approx(1.0));
}

TEST_CASE("parts do what they are named for") {
    CHECK(front_facing(0.5).value(-0.25) == 0.0);
    CHECK(front_facing(0.5).value(0.25) == 1.0);
    for (const double sign : {-1.0, 1.0}) {
        CHECK(far_from_plane(0.5, 1.0).value(sign * 0.5) == 0.0);
        CHECK(far_from_plane(0.5, 1.0).value(sign * 1.0) == 1.0);
        CHECK(near_plane(0.5, 1.0).value(sign * 0.5) == 1.0);
        CHECK(near_plane(0.5, 1.0).value(sign * 1.0) == 0.0);
        CHECK(on_silhouette(0.5).value(sign * 0.5) == 0.0);
        CHECK(off_silhouette(0.5).value(sign * 0.5) == 1.0);
    }
    CHECK(on_silhouette(0.5).value(0.0) == 1.0);
    CHECK(far_in_front(0.5, 1.0).value(-1.0) == 0.0);
    CHECK(far_in_front(0.5, 1.0).value(1.0) == 1.0);
    CHECK(near_in_front(0.5, 0.5, 1.0).value(-0.25) == 0.0);
    CHECK(near_in_front(0.5, 0.5, 1.0).value(0.3) == 1.0);
    CHECK(near_in_front(0.5, 0.5, 1.0).value(1.0) == 0.0);
}

}  // namespace
}  // namespace rimline
