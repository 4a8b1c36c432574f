#include "silhouette/lines/picture_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/lines/picture_kernels.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

struct Line {
    glm::dvec3 a, b;  // Places in the picture and depths.
    bool may_be_before;
};

// As those of a chain: each begins where the one before ends, or sometimes anywhere.
std::vector<Line> random_lines(std::size_t count, tests::Random& random) {
    std::vector<Line> lines;
    glm::dvec3 at(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        if (random.below(20) == 0) at = 3.0 * glm::dvec3(random.in_cube());
        const glm::dvec3 next = at + 0.3 * glm::dvec3(random.in_cube());
        lines.push_back({at, next, random.below(4) != 0});
        at = next;
    }
    return lines;
}

// Whether the boxes of two lines meet that are wider by `slack`, and `other` is nowhere behind `line`.
bool may_lie_before(const Line& line, const Line& other, double slack) {
    bool does = other.may_be_before;
    for (int i = 0; i < 3; ++i) {
        does = does && std::min(other.a[i], other.b[i]) <= std::max(line.a[i], line.b[i]) + slack;
        if (i < 2)
            does =
                does && std::max(other.a[i], other.b[i]) >= std::min(line.a[i], line.b[i]) - slack;
    }
    return does;
}

TEST_CASE("the tree finds each pair of lines whose boxes meet once") {
    constexpr std::uint64_t k_seed = 21;
    CAPTURE(k_seed);
    tests::Random random(k_seed);
    PictureTree tree;
    std::size_t pairs = 0;
    for (const std::size_t count : {0, 1, 2, 31, 32, 33, 500, 1023, 1024, 1025, 1300, 3}) {
        CAPTURE(count);
        const std::vector<Line> lines = random_lines(count, random);
        glm::dvec3 low(1e9), high(-1e9);
        for (const Line& line : lines) {
            low = glm::min(low, glm::min(line.a, line.b));
            high = glm::max(high, glm::max(line.a, line.b));
        }
        const PictureSteps steps(low, high);
        tree.clear();
        for (const Line& line : lines) {
            const PictureBox box = steps.box(line.a, line.b);
            tree.add(box, line.may_be_before ? box : k_empty_picture_box);
        }
        tree.finish();
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
        tree.each_pair(
            [&](std::uint32_t line, std::uint32_t other) { found.emplace_back(line, other); });
        std::ranges::sort(found);
        CHECK(std::ranges::adjacent_find(found) == found.end());
        // Boxes are rounded outwards by at most a step on each side.
        const double step = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 32'767.0;
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t j = 0; j < count; ++j) {
                const bool is_found = std::ranges::binary_search(found, std::pair(i, j));
                if (may_lie_before(lines[i], lines[j], 0.0)) REQUIRE(is_found);
                if (is_found) REQUIRE(may_lie_before(lines[i], lines[j], 2.001 * step));
            }
        pairs += found.size();
    }
    CHECK(pairs > 5000);
}

TEST_CASE("a box that includes others meets what they meet, and an empty one nothing") {
    PictureBox all = k_empty_picture_box;
    const PictureSteps steps({0, 0, 0}, {1, 1, 1});
    const PictureBox a = steps.box({0.1, 0.2, 0.3}, {0.2, 0.1, 0.4});
    const PictureBox b = steps.box({0.6, 0.9, 0.1}, {0.7, 0.8, 0.2});
    all.include(a);
    all.include(b);
    PictureBoxes boxes;
    for (std::size_t k = 0; k < PictureBoxes::k_boxes; ++k) boxes.set(k, k_empty_picture_box);
    boxes.set(1, a);
    boxes.set(4, b);
    boxes.set(31, all);
    using Numbers = std::vector<std::uint32_t>;
    const std::vector<PictureBoxes> level{PictureBoxes{}, boxes};
    tests::for_each_instruction_set([&](const std::string& name) {
        CAPTURE(name);
        const auto found = [&](const PictureBox& box) {
            Numbers numbers(PictureBoxes::k_boxes);
            const Numbers blocks{1};
            numbers.resize(kernels::find_before(level, blocks, box, numbers.data()));
            // A level above, whose second box is that of block 1.
            std::vector<PictureBoxes> above(1);
            for (std::size_t k = 0; k < PictureBoxes::k_boxes; ++k)
                above[0].set(k, k == 1 ? all : k_empty_picture_box);
            Numbers found_blocks(PictureBoxes::k_boxes), below(PictureBoxes::k_boxes);
            const Numbers first{0};
            below.resize(
                kernels::find_below(above, first, level, box, found_blocks.data(), below.data()));
            CHECK(below == numbers);
            return numbers;
        };
        CHECK(found(steps.box({0, 0, 0}, {1, 1, 1})) == Numbers{33, 36, 63});
        CHECK(found(a) == Numbers{33, 63});
        // Nearer than the first, and as far as the second.
        CHECK(found(steps.box({0.1, 0.1, 0.1}, {0.9, 0.9, 0.25})) == Numbers{36, 63});
        CHECK(found(steps.box({0.65, 0.85, 0.0}, {0.65, 0.85, 0.05})) == Numbers{});
        CHECK(found(k_empty_picture_box) == Numbers{});
    });
}

}  // namespace
}  // namespace rimline
