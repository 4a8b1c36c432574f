#include "engine/frame/line_segments.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/stops.h"

namespace rimline {
namespace {

// A picture of 200 x 100 pixels; picture coordinates are 50 pixels long.
gpu::FrameData frame() {
    return {.clip_scale = glm::vec2(0.5f, -1.0f) / 2.0f,
            .extent = {200.0f, 100.0f},
            .line_radius = 2.0f,
            .hidden_strength = 0.5f,
            .dash_period = 10.0f,
            .dash_length = 6.0f,
            .guard = 2.0f};
}

std::vector<gpu::LineSegment> segments_of(const PictureLines& lines,
                                          const gpu::FrameData& data = frame()) {
    std::vector<gpu::LineSegment> segments;
    add_line_segments(lines, k_own_line_color, data, segments);
    return segments;
}

// Ink at a place of the dash pattern, as line_coverage.glsl has it.
bool is_inked(float place) {
    const float from_center = std::abs(place / 10.0f - std::floor(place / 10.0f) - 0.5f) * 10.0f;
    return from_center <= 0.5f * 6.0f - 0.5f + 1e-3f;
}

TEST_CASE("segments are in pixels, y downwards, and the visible ones are solid") {
    const auto segments = segments_of({{{0, 0}, {1, 0}, {1, 0.5}}, {{0, 3}}});
    REQUIRE(segments.size() == 2);
    CHECK(segments[0].ends == glm::vec4(100, 50, 150, 50));
    CHECK(segments[1].ends == glm::vec4(150, 50, 150, 25));
    for (const gpu::LineSegment& segment : segments) {
        CHECK(segment.strength == 1.0f);
        CHECK(segment.dashes.x == segment.dashes.y);
        CHECK(is_inked(segment.dashes.x));
    }
    // Off the axis: by a tenth of the width to the right, a quarter of the height up.
    gpu::FrameData shifted = frame();
    shifted.clip_shift = glm::vec2(0.2f, -0.5f) / 2.0f;
    const glm::vec4 ends = segments_of({{{0, 0}, {1, 0}}, {{0, 2}}}, shifted)[0].ends;
    CHECK(glm::distance(ends, glm::vec4(120, 25, 170, 25)) < 1e-4f);
    // A line of one point is a dot.
    const auto dot = segments_of({{{0, 0}}, {{0, 1}}});
    REQUIRE(dot.size() == 1);
    CHECK(dot[0].ends == glm::vec4(100, 50, 100, 50));
}

TEST_CASE("segments are cut where the widened picture ends, and none lies outside") {
    const auto segments =
        segments_of({{{-1e9, 0}, {1e9, 0}, {1e9, 1e9}, {0, 0}, {0, 1.1}, {5, 1.1}}, {{0, 6}}});
    REQUIRE(segments.size() == 3);
    CHECK(segments[0].ends.x == doctest::Approx(-(2.0 + RIMLINE_INK_REACH)));
    CHECK(segments[0].ends.z == doctest::Approx(202.0 + RIMLINE_INK_REACH));
    CHECK(segments[0].ends.y == doctest::Approx(50.0));
    CHECK(segments[1].ends.y ==
          doctest::Approx(-(2.0 + RIMLINE_INK_REACH)));  // Along the diagonal, upwards.
    CHECK(segments[1].ends.x == doctest::Approx(152.0 + RIMLINE_INK_REACH));
    CHECK(segments[2].ends.w == doctest::Approx(-(2.0 + RIMLINE_INK_REACH)));
}

TEST_CASE("points that are not finite or beyond all pictures stop the program") {
    const auto with = [](double x) { return [x] { segments_of({{{0, 0}, {x, 0}}, {{0, 2}}}); }; };
    CHECK_FALSE(tests::stops(with(1e25)));
    for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
        CAPTURE(x);
        CHECK(tests::stops(with(x)));
    }
}

TEST_CASE("a hidden line has the strength of hidden lines, and is left out if that is 0") {
    const PictureLines lines{{{0, 0}, {1, 0}}, {{0, 2, true}}};
    gpu::FrameData data = frame();
    REQUIRE(segments_of(lines).size() == 1);
    CHECK(segments_of(lines)[0].strength == 0.5f);
    data.hidden_strength = 0.0f;
    CHECK(segments_of(lines, data).empty());
}

TEST_CASE("dashes go on from segment to segment, and a line begins and ends with a whole one") {
    for (double length = 0.02; length < 1.9; length += 0.037) {
        CAPTURE(length);
        const auto segments =
            segments_of({{{0, -0.9}, {0.3 * length, -0.9}, {0.3 * length, -0.9 + 0.7 * length}},
                         {{0, 3, true}}});
        REQUIRE(segments.size() == 2);
        CHECK(segments[0].dashes.y == doctest::Approx(segments[1].dashes.x));
        const float begin = segments[0].dashes.x, end = segments[1].dashes.y;
        CHECK(is_inked(begin));
        CHECK(is_inked(end));
        const bool is_one_dash = begin == end;
        CHECK(is_one_dash == (length * 50.0 < 10.0));
        // A period is no shorter than 6.8 pixels and no longer than 15.
        if (is_one_dash) continue;
        const double stretched = length * 50.0 / double(end - begin);
        CHECK(stretched > 0.67);
        CHECK(stretched < 1.5);
    }
}

TEST_CASE("a closed hidden line has whole periods") {
    const auto segments =
        segments_of({{{0, 0}, {0.83, 0}, {0.83, 0.31}, {0, 0.31}}, {{0, 4, true, true}}});
    REQUIRE(segments.size() == 4);
    const double periods = double(segments[3].dashes.y - segments[0].dashes.x) / 10.0;
    CHECK(periods == doctest::Approx(11.0));
    for (std::size_t i = 0; i + 1 < 4; ++i)
        CHECK(segments[i].dashes.y == doctest::Approx(segments[i + 1].dashes.x));
}

}  // namespace
}  // namespace rimline
