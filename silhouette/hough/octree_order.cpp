#include "silhouette/hough/octree_order.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <limits>

#include "silhouette/error.h"

namespace rimline {

namespace {

struct CodedPoint {
    std::uint64_t code;
    std::uint32_t point;
};

// Spreads 21 bits to every third of 63.
std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

// Sorts a range by Morton codes in the bounding cube of its points. False where they all coincide.
bool sort_in_own_cube(std::span<const glm::dvec3> points, std::span<CodedPoint> range) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const CodedPoint& coded : range) {
        low = glm::min(low, points[coded.point]);
        high = glm::max(high, points[coded.point]);
    }
    const glm::dvec3 size = high - low;
    const double side = std::max({size.x, size.y, size.z});
    if (!(side > 0.0)) return false;
    constexpr double k_cells = std::uint64_t{1} << k_octree_cube_depth;
    const auto cell = [&](double offset) {
        return spread(static_cast<std::uint64_t>(std::min(offset / side * k_cells, k_cells - 1.0)));
    };
    for (CodedPoint& coded : range) {
        const glm::dvec3 offset = points[coded.point] - low;
        coded.code = cell(offset.x) << 2 | cell(offset.y) << 1 | cell(offset.z);
    }
    std::sort(range.begin(), range.end(), [](const CodedPoint& a, const CodedPoint& b) {
        return a.code != b.code ? a.code < b.code : a.point < b.point;
    });
    return true;
}

}  // namespace

OctreeOrder octree_order(std::span<const glm::dvec3> points, std::uint32_t bucket_size) {
    RIMLINE_CHECK(bucket_size > 0);
    const auto count = static_cast<std::uint32_t>(points.size());
    if (count == 0) return {};

    std::vector<CodedPoint> coded(count);
    for (std::uint32_t i = 0; i < count; ++i) coded[i] = {0, i};

    OctreeOrder result;
    result.cells.push_back({0, count, 0, 0});
    std::vector<std::uint32_t> cubes{0};  // For each cell, how many its points were sorted in.
    for (std::uint32_t parent = 0; parent < result.cells.size(); ++parent) {
        const OctreeCell cell = result.cells[parent];
        if (cell.end - cell.begin <= bucket_size) continue;
        // Codes are all 0 before the first sorting, so the root is sorted here as well.
        if (coded[cell.begin].code == coded[cell.end - 1].code) {
            const std::span range = std::span(coded).subspan(cell.begin, cell.end - cell.begin);
            if (cubes[parent] == k_octree_max_cubes || !sort_in_own_cube(points, range)) continue;
            ++cubes[parent];
        }
        // The two ends of a cube's longest axis never share a code, so there are bits that differ.
        const std::uint64_t differing = coded[cell.begin].code ^ coded[cell.end - 1].code;
        const auto shift = static_cast<std::uint32_t>((std::bit_width(differing) - 1) / 3 * 3);
        const auto first_child = static_cast<std::uint32_t>(result.cells.size());
        for (std::uint32_t begin = cell.begin; begin < cell.end;) {
            const std::uint64_t octant = coded[begin].code >> shift;
            const auto end = static_cast<std::uint32_t>(
                std::partition_point(
                    coded.begin() + begin, coded.begin() + cell.end,
                    [&](const CodedPoint& p) { return p.code >> shift == octant; }) -
                coded.begin());
            result.cells.push_back({begin, end, 0, 0});
            cubes.push_back(cubes[parent]);
            begin = end;
        }
        result.cells[parent].first_child = first_child;
        result.cells[parent].child_count =
            static_cast<std::uint32_t>(result.cells.size()) - first_child;
    }
    result.order.reserve(count);
    for (const CodedPoint& p : coded) result.order.push_back(p.point);
    return result;
}

}  // namespace rimline
