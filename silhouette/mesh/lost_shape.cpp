#include "silhouette/mesh/lost_shape.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace rimline {

namespace {

constexpr std::size_t k_max_edges = 1024;
constexpr double k_most_of_extent = 1.0 / 32.0;

// Infinite where no edge has a length.
double median_length(std::span<const glm::vec3> positions,
                     std::span<const std::array<std::uint32_t, 3>> triangles) {
    const std::size_t count = std::min(triangles.size(), k_max_edges);
    std::vector<double> lengths;
    lengths.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& triangle = triangles[i * triangles.size() / count];
        const double length =
            glm::distance(glm::dvec3(positions[triangle[0]]), glm::dvec3(positions[triangle[1]]));
        if (length > 0.0) lengths.push_back(length);
    }
    if (lengths.empty()) return std::numeric_limits<double>::infinity();
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

}  // namespace

double detail_size(std::span<const glm::vec3> positions,
                   std::span<const std::array<std::uint32_t, 3>> triangles) {
    if (positions.empty() || triangles.empty()) return 0.0;
    glm::vec3 low(positions.front()), high(low);
    for (const glm::vec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const double extent = glm::distance(glm::dvec3(low), glm::dvec3(high));
    return std::min(median_length(positions, triangles), k_most_of_extent * extent);
}

}  // namespace rimline
