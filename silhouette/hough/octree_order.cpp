#include "silhouette/hough/octree_order.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

#include "silhouette/error.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_bits = 16;
constexpr std::size_t k_grain = 4096;

struct CodedPoint {
    std::uint64_t code;
    std::uint32_t point;

    bool operator<(const CodedPoint& other) const noexcept {
        return code != other.code ? code < other.code : point < other.point;
    }
};

struct Cube {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void include(const Cube& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    double side() const {
        const glm::dvec3 size = high - low;
        return std::max({size.x, size.y, size.z});
    }
};

// Spreads 16 bits to every third of 48.
std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

// J. Skilling, Programming the Hilbert curve (2004), for three axes.
std::uint64_t hilbert_code(std::array<std::uint32_t, 3> x) {
    for (std::uint32_t bit = 1u << (k_bits - 1); bit > 1; bit >>= 1) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& axis : x) {
            // Invert the low bits of x[0] where the bit is set, else exchange them with this axis's:
            // without a branch, which would be taken at random.
            const std::uint32_t is_set = axis & bit ? ~0u : 0u;
            const std::uint32_t exchanged = (x[0] ^ axis) & below & ~is_set;
            x[0] ^= exchanged | (below & is_set);
            axis ^= exchanged;
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t gray = 0;
    for (std::uint32_t bit = 1u << (k_bits - 1); bit > 1; bit >>= 1)
        if (x[2] & bit) gray ^= bit - 1;
    return spread(x[0] ^ gray) << 2 | spread(x[1] ^ gray) << 1 | spread(x[2] ^ gray);
}

using Points = std::span<const glm::dvec3>;

Cube bounding_cube(Points points, std::span<const CodedPoint> range) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, range.size(), k_grain), Cube{},
        [&](const tbb::blocked_range<std::size_t>& part, Cube cube) {
            for (std::size_t i = part.begin(); i < part.end(); ++i)
                cube.include({points[range[i].point], points[range[i].point]});
            return cube;
        },
        [](Cube a, const Cube& b) {
            a.include(b);
            return a;
        });
}

void sort_in_own_cube(Points points, std::span<const std::uint8_t> sizes,
                      std::span<CodedPoint> range, std::uint32_t cubes) {
    const Cube cube = bounding_cube(points, range);
    const double side = cube.side();
    if (!(side > 0.0) && sizes.empty()) return;
    constexpr double k_cells = 1u << k_bits;
    const auto cell = [&](double offset) {
        const double part = side > 0.0 ? offset / side : 0.0;
        return static_cast<std::uint32_t>(std::min(part * k_cells, k_cells - 1.0));
    };
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, range.size(), k_grain),
        [&](const tbb::blocked_range<std::size_t>& part) {
            for (std::size_t i = part.begin(); i < part.end(); ++i) {
                CodedPoint& coded = range[i];
                const glm::dvec3 offset = points[coded.point] - cube.low;
                coded.code = hilbert_code({cell(offset.x), cell(offset.y), cell(offset.z)});
                if (!sizes.empty()) coded.code |= std::uint64_t{sizes[coded.point]} << 3 * k_bits;
            }
        });
    tbb::parallel_sort(range.begin(), range.end());
    if (cubes + 1 == k_octree_max_cubes || !(side > 0.0)) return;
    for (std::size_t begin = 0; begin < range.size();) {
        std::size_t end = begin + 1;
        while (end < range.size() && range[end].code == range[begin].code) ++end;
        if (end - begin > 1)
            sort_in_own_cube(points, {}, range.subspan(begin, end - begin), cubes + 1);
        begin = end;
    }
}

}  // namespace

std::vector<std::uint32_t> octree_order(Points points, std::span<const std::uint8_t> sizes) {
    RIMLINE_CHECK(sizes.empty() || sizes.size() == points.size());
    std::vector<CodedPoint> coded(points.size());
    for (std::uint32_t i = 0; i < coded.size(); ++i) coded[i] = {0, i};
    sort_in_own_cube(points, sizes, coded, 0);
    std::vector<std::uint32_t> order;
    order.reserve(coded.size());
    for (const CodedPoint& p : coded) order.push_back(p.point);
    return order;
}

}  // namespace rimline
