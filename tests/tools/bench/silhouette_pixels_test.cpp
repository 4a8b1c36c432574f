#include "tools/bench/silhouette_pixels.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <string>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/skip.h"

namespace rimline::tools {
namespace {

PixelMask mask_from(const std::string& rows, std::uint32_t width) {
    PixelMask mask(width, static_cast<std::uint32_t>(rows.size()) / width);
    for (std::size_t i = 0; i < rows.size(); ++i) mask.at[i] = rows[i] == '#' ? 1 : 0;
    return mask;
}

TEST_CASE("a mask is widened to a square around each pixel and ends at its borders") {
    const PixelMask mask = mask_from(
        "#......"
        "......."
        "....#.."
        "......."
        "......#",
        7);
    CHECK(mask.widened(0).at == mask.at);
    CHECK(mask.widened(1).at == mask_from("##....."
                                          "##.###."
                                          "...###."
                                          "...####"
                                          ".....##",
                                          7)
                                    .at);
    CHECK(mask.widened(9).count() == 35);
    CHECK(mask.count() == 3);
}

TEST_CASE("a pixel is found within one pixel and extra beyond two of every line") {
    const PixelMask none(12, 1);
    const TruePixels truth{mask_from("#...#.......", 12), mask_from("........#...", 12),
                           mask_from("#..........#", 12)};
    const auto hits_of = [&](const std::string& marked) {
        return count_hits(truth, mask_from(marked, 12));
    };
    OutlineHits hits = hits_of("............");
    CHECK(hits.truth == 2);
    CHECK(hits.missed == 2);
    CHECK(hits.marked == 0);
    CHECK(hits.missed_share() == 1.0);
    CHECK(hits.extra_share() == 0.0);
    hits = hits_of(".#..........");
    CHECK(hits.missed == 1);
    CHECK(hits.extra + hits.borders + hits.creases == 0);
    hits = hits_of("..#.........");  // Two pixels away: neither found nor extra.
    CHECK(hits.missed == 2);
    CHECK(hits.extra + hits.borders + hits.creases == 0);
    hits = hits_of("......#.....");  // At a silhouette and at a border: of the silhouette.
    CHECK(hits.borders == 0);
    hits = hits_of(".......#....");
    CHECK(hits.borders == 1);
    hits = hits_of("..........#.");  // At a border and at a crease: of the border.
    CHECK(hits.borders == 1);
    CHECK(hits.creases == 0);
    hits = hits_of("...........#");
    CHECK(hits.creases == 1);
    CHECK(count_hits({none, none, none}, mask_from("..##........", 12)).extra == 2);
    hits += hits;
    CHECK(hits.creases == 2);
    CHECK(hits.truth == 4);
}

TEST_CASE("the true pixels of a sphere are its circle") {
    if (!PieceRays::missing().empty()) RIMLINE_SKIP(PieceRays::missing().data());
    constexpr std::uint32_t k_size = 256;
    const Mesh sphere(make_built_in_shape("sphere", 20'000));
    const PieceRays rays(sphere);
    const TruePixels truth = find_true_pixels(
        sphere, rays, {.eye = {0, 0, 4}, .up = {0, 1, 0}, .fov_y_deg = 40.0}, k_size, k_size);
    CHECK(truth.borders.count() == 0);
    CHECK(truth.creases.count() == 0);
    const double radius = 0.5 * k_size / std::tan(glm::radians(20.0)) / std::sqrt(15.0);
    const glm::dvec2 center(0.5 * k_size);
    for (std::size_t i = 0; i < truth.silhouettes.at.size(); ++i)
        if (truth.silhouettes.at[i] != 0)
            CHECK(std::abs(glm::distance(glm::dvec2(i % k_size, i / k_size) + 0.5, center) -
                           radius) < 0.5 * std::numbers::sqrt2 + 0.2);
    const PixelMask near = truth.silhouettes.widened(1);
    for (double degrees = 0.0; degrees < 360.0; degrees += 0.25) {
        const double angle = glm::radians(degrees);
        const glm::dvec2 place = center + radius * glm::dvec2(std::cos(angle), std::sin(angle));
        CHECK(near.at[std::size_t(place.y) * k_size + std::size_t(place.x)] == 1);
    }
}

TEST_CASE("true pixels are only where nothing hides the edge") {
    if (!PieceRays::missing().empty()) RIMLINE_SKIP(PieceRays::missing().data());
    constexpr std::uint32_t k_size = 128;
    // A small square, and a larger one before or behind it. All of their edges are borders.
    for (const float z : {0.5f, -0.5f}) {
        const MeshSource source{{{-0.2f, -0.2f, 0},
                                 {0.2f, -0.2f, 0},
                                 {0, 0.2f, 0},
                                 {-0.6f, -0.6f, z},
                                 {0.6f, -0.6f, z},
                                 {0, 0.6f, z}},
                                {{0, 1, 2}, {3, 4, 5}}};
        const Mesh mesh(source);
        const PieceRays rays(mesh);
        const TruePixels truth =
            find_true_pixels(mesh, rays, {.eye = {0, 0, 4}, .fov_y_deg = 30.0}, k_size, k_size);
        CHECK(truth.silhouettes.count() == 0);
        // The lower edge of the small one is 0.2 below the middle, 4 before the eye.
        const double row = 0.5 * k_size * (1.0 + 0.05 / std::tan(glm::radians(15.0)));
        CHECK(truth.borders.at[std::size_t(row) * k_size + k_size / 2] == (z < 0.0f ? 1 : 0));
    }
}

}  // namespace
}  // namespace rimline::tools
