#include "tools/output/slice_picture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/output/canvas.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("a cut of a sphere is a circle around the axis") {
    const Mesh mesh(make_built_in_shape("sphere", 20'000));
    for (const int axis : {0, 1, 2}) {
        CAPTURE(axis);
        const double value = mesh.center()[axis] + 0.3 * mesh.radius();
        double length = 0.0;
        for (const auto& [from, to] : cut_segments(mesh, axis, value)) {
            length += glm::distance(from, to);
            for (const glm::dvec3& p : {from, to}) {
                CHECK(std::abs(p[axis] - value) < 1e-9);
                CHECK(glm::distance(p, mesh.center()) / mesh.radius() ==
                      doctest::Approx(1.0).epsilon(0.002));
            }
        }
        const double circle = 2.0 * 3.141592653589793 * std::sqrt(1.0 - 0.09) * mesh.radius();
        CHECK(length == doctest::Approx(circle).epsilon(0.005));
    }
    CHECK(cut_segments(mesh, 0, mesh.center().x + 1.01 * mesh.radius()).empty());
}

TEST_CASE("the squares of a slice are those of the ball or shell, and each has its point") {
    const SliceGrid grid(1, 0.5, 1.0, 2.0, 64);
    CHECK(grid.squares().size() == grid.points().size());
    std::size_t expected = 0;
    for (int row = 0; row < 64; ++row)
        for (int column = 0; column < 64; ++column) {
            const double x = 2.0 * (2.0 * (column + 0.5) / 64 - 1.0);
            const double z = 2.0 * (1.0 - 2.0 * (row + 0.5) / 64);
            const double squared = x * x + 0.25 + z * z;
            if (squared < 1.0 || squared > 4.0) continue;
            CHECK(grid.squares()[expected] == std::uint32_t(64 * row + column));
            CHECK(glm::distance(grid.points()[expected], glm::dvec3(x, 0.5, z)) < 1e-12);
            ++expected;
        }
    CHECK(expected == grid.squares().size());
    CHECK(SliceGrid(1, 2.5, 1.0, 2.0, 64).points().empty());
}

TEST_CASE("the model is where the axes say, and its values are under it") {
    // Of a sphere around (5, 0, 0), seen along z, the outline is a circle around the plot's middle.
    MeshSource source = make_built_in_shape("sphere", 2'000);
    for (glm::vec3& p : source.positions) p.x += 5.0f;
    const Mesh mesh(source);
    const int side = 200;
    const SliceGrid grid(2, 0.0, 0.0, 3.0, side);
    const std::vector<double> values(grid.points().size(), 1.0);
    const Canvas canvas = draw_slice({mesh, unit_frame(mesh), grid, values, "a title", "votes"});
    // Its horizontal diameter is a third of the plot's. Rows of the plot's middle begin at `left`.
    const int row = 20 + side / 2;
    const auto is_dark = [&](int x) {
        return canvas.picture().rgba[4 * (std::size_t(row) * canvas.width() + std::size_t(x)) + 2] <
               60;
    };
    const int left = 44;
    std::vector<int> dark;
    for (int x = left; x < left + side; ++x)
        if (is_dark(x)) dark.push_back(x - left);
    REQUIRE(dark.size() >= 2);
    CHECK(std::abs(dark.front() - side / 3) <= 2);
    CHECK(std::abs(dark.back() - 2 * side / 3) <= 2);
}

TEST_CASE("narrow plots leave out words that have no room") {
    const Mesh mesh(make_built_in_shape("sphere", 200));
    const std::string title = "origins, y = 0.673";
    const int left = 44, top = 20;
    const int title_end = left + Canvas::text_width(title, 1);
    // Whether dark pixels lie above the plot, in columns from `begin` to before `end`.
    const auto has_words = [&](int side, int begin, int end) {
        const SliceGrid grid(2, 0.0, 0.0, 2.0, side);
        std::vector<double> values(grid.points().size(), 1.0);
        values[values.size() / 2] = 2.0;
        const Canvas canvas = draw_slice({mesh, unit_frame(mesh), grid, values, title, "votes"});
        for (int y = 0; y < top; ++y)
            for (int x = begin; x < end; ++x)
                if (canvas.picture().rgba[4 * (std::size_t(y) * canvas.width() + std::size_t(x))] <
                    60)
                    return true;
        return false;
    };
    CHECK_FALSE(has_words(64, left, left + 64));
    CHECK(has_words(128, left, title_end));
    CHECK_FALSE(has_words(128, title_end, left + 128));
    CHECK(has_words(250, left, title_end));
    CHECK_FALSE(has_words(250, title_end, title_end + 8));
    CHECK(has_words(250, title_end + 8, left + 250));
}

TEST_CASE("a field of one value has it beside the color that all points have") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const SliceGrid grid(2, 0.0, 0.0, 2.0, 200);
    const auto drawn = [&](double value) {
        return draw_slice({mesh, unit_frame(mesh), grid, std::vector(grid.points().size(), value),
                           "views, z = 0", "votes"})
            .picture();
    };
    // Titles and units are above, axes left and below: only the number differs.
    CHECK(drawn(1.25).rgba != drawn(2.25).rgba);
    CHECK(drawn(1.25).rgba == drawn(1.25).rgba);
}

TEST_CASE("numbers of a slice have room") {
    // Columns and rows beside the plot with ink are those of numbers; none reach the picture's border or each other.
    for (const float shift : {0.0f, 4'000.0f, -9'000'000.0f})
        for (const int side : {16, 40, 200, 600}) {
            CAPTURE(shift);
            CAPTURE(side);
            MeshSource source = make_built_in_shape("box", 12);
            for (glm::vec3& p : source.positions) p = 0.5f * p + glm::vec3(shift, shift, 0.0f);
            const Mesh mesh(source);
            const SliceGrid grid(2, 0.0, 0.0, 2.0, side);
            std::vector<double> values;
            for (std::size_t i = 0; i < grid.points().size(); ++i)
                values.push_back(double(i) * (1.0 + std::abs(double(shift))));
            const Canvas canvas = draw_slice({mesh, unit_frame(mesh), grid, values, "", ""});
            const int width = static_cast<int>(canvas.width()),
                      height = static_cast<int>(canvas.height());
            const auto is_dark = [&](int x, int y) {
                return canvas.picture()
                           .rgba[4 * (std::size_t(y) * canvas.width() + std::size_t(x))] < 100;
            };
            const int scale = std::max(1, side / 256);
            int left = 0;  // Of the plot: its vertical axis is the longest dark column.
            for (int x = 0, longest = 0; x < width; ++x) {
                int count = 0;
                for (int y = 0; y < height; ++y) count += is_dark(x, y);
                if (count > longest) {
                    longest = count;
                    left = x;
                }
            }
            for (int y = 0; y < height; ++y) {
                CHECK_FALSE(is_dark(0, y));
                CHECK_FALSE(is_dark(width - 1, y));
            }
            // Each line of text is seven pixels high, and three pixels are between two.
            const auto check_lines = [&](int first, int last) {
                int run = 0;
                for (int y = 0; y < height; ++y) {
                    bool has_ink = false;
                    for (int x = first; x < last; ++x) has_ink = has_ink || is_dark(x, y);
                    run = has_ink ? run + 1 : 0;
                    CHECK(run <= 8 * scale);
                }
            };
            check_lines(0, left - 5 * scale);
            check_lines(left + side + 34 * scale, width);  // Beside the bar of colors.
        }
}
