#include "tools/output/plot_scale.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace rimline::tools;

TEST_CASE("ticks are at round numbers, and as many as asked for at most") {
    CHECK(round_step(10.0, 5) == doctest::Approx(2.0));
    CHECK(round_step(10.0, 4) == doctest::Approx(5.0));
    CHECK(round_step(0.07, 7) == doctest::Approx(0.01));
    CHECK(round_step(6.1e6, 6) == doctest::Approx(2e6));
    CHECK(round_ticks(-1.3, 2.1, 4) == std::vector<double>{-1.0, 0.0, 1.0, 2.0});
    for (const double range : {1e-7, 0.3, 17.0, 9.99e8})
        for (const int steps : {1, 3, 7}) {
            const std::size_t count = round_ticks(0.4 * range, 1.4 * range, steps).size();
            CHECK(count <= std::size_t(steps) + 1);
            CHECK(2.5 * double(count + 1) >= steps);
        }
}

TEST_CASE("a range of hardly more than one number has few ticks") {
    for (const double low : {1.0, -5.0, 3e300, 1e-300})
        CHECK(round_ticks(low, std::nextafter(low, 1e308), 6).size() <= 7);
}

TEST_CASE("numbers have the digits that tell ticks apart") {
    CHECK(short_number(0.2, 0.1) == "0.2");
    CHECK(short_number(-0.25, 0.05) == "-0.25");
    CHECK(short_number(64000.0, 2000.0) == "64000");
    CHECK(short_number(2e-7, 1e-7) == "2e-07");
    CHECK(short_number(1.0000002, 1e-7) == "1.0000002");
    CHECK(short_number(4.5e9, 1e6) == "4.5e+09");
    CHECK(short_number(4.5e9 + 2e6, 1e6) == "4.502e+09");
    CHECK(short_number(3.0, 0.5) == "3.0");
}

TEST_CASE("a scale bar is as long as its number says") {
    Canvas canvas(200, 60, {255, 255, 255});
    draw_scale_bar(canvas, 10, 50, 100, 23.0, "", {0, 0, 0}, 1);  // At most 4.3 units: 2.
    int columns = 0;
    for (int x = 0; x < 200; ++x)
        columns += canvas.picture().rgba[4 * (std::size_t(49) * 200 + std::size_t(x))] == 0;
    CHECK(columns == 46);
}
