#include "silhouette/field/tangential_function.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

TangentialFunction random_function(tests::Random& random, bool with_slopes) {
    std::vector<TangentialFunction::Knot> knots;
    double at = -2.0;
    const std::uint32_t count = 1 + random.below(6);
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool outer = i == 0 || i + 1 == count;
        knots.push_back(
            {at, random.signed_unit(), with_slopes && !outer ? double{random.signed_unit()} : 0.0});
        at += 0.05 + 0.5 * (1.0 + random.signed_unit());
    }
    return TangentialFunction(knots);
}

TEST_CASE("the step between two knots is 3x^2 - 2x^3") {
    const TangentialFunction f({{-1.0, 2.0}, {3.0, 5.0}});
    for (double x = 0.0; x <= 1.0; x += 0.0625) {
        const double s = -1.0 + 4.0 * x;
        CHECK(f.value(s) == doctest::Approx(2.0 + 3.0 * (3.0 * x * x - 2.0 * x * x * x)));
        CHECK(f.slope(s) == doctest::Approx(3.0 * 6.0 * x * (1.0 - x) / 4.0));
    }
    CHECK(f.value(-1e30) == 2.0);
    CHECK(f.value(1e30) == 5.0);
    CHECK(f.slope(-1e30) == 0.0);
    CHECK(f.min_value() == 2.0);
    CHECK(f.max_value() == 5.0);
    CHECK(f.max_slope() == doctest::Approx(3.0 * 1.5 / 4.0));
}

TEST_CASE("a function passes its knots with their slopes and is C1 there") {
    tests::Random random(11);
    for (int round = 0; round < 50; ++round) {
        const TangentialFunction f = random_function(random, true);
        for (const TangentialFunction::Knot& k : f.knots()) {
            for (const double side : {-1e-9, 0.0, 1e-9}) {
                CHECK(std::abs(f.value(k.distance + side) - k.value) < 1e-7);
                CHECK(std::abs(f.slope(k.distance + side) - k.slope) < 1e-5);
            }
        }
    }
}

TEST_CASE("slopes and curvatures are the derivatives of values and slopes") {
    tests::Random random(12);
    for (int round = 0; round < 50; ++round) {
        const TangentialFunction f = random_function(random, true);
        for (int i = 0; i < 100; ++i) {
            const double s = 3.0 * random.signed_unit();
            const double h = 1e-6;
            const auto& piece = f.piece_at(s);
            if (s - h < piece.from || s + h > piece.to) continue;
            CHECK(std::abs((f.value(s + h) - f.value(s - h)) / (2 * h) - f.slope(s)) < 1e-5);
            CHECK(std::abs((f.slope(s + h) - f.slope(s - h)) / (2 * h) - f.curvature(s)) < 1e-4);
        }
    }
}

TEST_CASE("least, greatest and steepest are those of a fine scan") {
    tests::Random random(13);
    for (int round = 0; round < 50; ++round) {
        const TangentialFunction f = random_function(random, true);
        double least = f.value(-9.0), greatest = least, steepest = 0.0;
        for (double s = -3.0; s < 9.0; s += 1e-4) {
            least = std::min(least, f.value(s));
            greatest = std::max(greatest, f.value(s));
            steepest = std::max(steepest, std::abs(f.slope(s)));
        }
        CHECK(f.min_value() <= least + 1e-14);
        CHECK(f.min_value() == doctest::Approx(least).epsilon(1e-5));
        CHECK(f.max_value() >= greatest - 1e-14);
        CHECK(f.max_value() == doctest::Approx(greatest).epsilon(1e-5));
        CHECK(f.max_slope() >= steepest * (1.0 - 1e-12));
        CHECK(f.max_slope() <= steepest + 0.05);
    }
}

TEST_CASE("least and greatest are those of the knots, wherever these lie") {
    tests::Random random(9);
    for (int n = 0; n < 1000; ++n) {
        CAPTURE(n);
        const double a = double{random.signed_unit()} - 1.5, b = double{random.signed_unit()} / 3.0;
        const TangentialFunction rising({{a, 0.0}, {b, 1.0}});
        CHECK(std::abs(rising.min_value()) < 1e-12);
        CHECK(std::abs(rising.max_value() - 1.0) < 1e-12);
        CHECK(std::abs(TangentialFunction({{a, 1.0}, {b, -2.0}}).min_value() + 2.0) < 1e-12);
        CHECK(rising.max_slope() >= 1.5 / (b - a) * (1.0 - 1e-12));
    }
}

TEST_CASE("sums, multiples and reflections are those of the values") {
    tests::Random random(14);
    for (int round = 0; round < 50; ++round) {
        const TangentialFunction f = random_function(random, true);
        const TangentialFunction g = random_function(random, true);
        const TangentialFunction sum = f + g;
        const TangentialFunction twice = f * -2.5;
        const TangentialFunction mirrored = f.reflected();
        for (double s = -4.0; s < 8.0; s += 0.01) {
            CHECK(std::abs(sum.value(s) - (f.value(s) + g.value(s))) < 1e-12);
            CHECK(std::abs(twice.value(s) + 2.5 * f.value(s)) < 1e-12);
            CHECK(std::abs(mirrored.value(-s) - f.value(s)) < 1e-12);
        }
    }
}

TEST_CASE("a function followed by another is each on its side") {
    const TangentialFunction step({{-1.0, 0.0}, {1.0, 1.0}});
    const TangentialFunction down({{2.0, 1.0}, {3.0, 0.25}});
    const TangentialFunction both = step.followed_by(down, 1.5);
    for (double s = -2.0; s < 4.0; s += 0.01)
        CHECK(std::abs(both.value(s) - (s < 1.5 ? step.value(s) : down.value(s))) < 1e-12);
}

}  // namespace
}  // namespace rimline
