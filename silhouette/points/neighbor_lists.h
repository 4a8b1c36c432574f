#pragma once

// The neighbors of each point: the k nearest, and whoever counts it among its own k nearest.
//
// k nearest neighbors are not mutual: next to a denser region all k lie on its side, and the umbrella
// looks open on the other. Made mutual, a fifth fewer interior points are taken for border. A point in
// the middle of a sparse region may be counted by many; the nearest k_max_neighbors stay.
//
// Where points lie in rows, far denser along than across, most of the k lie in the same row, and it alone
// spans no plane or a wrong one. There, wherever directions to the k spread along a line, a point has its
// nearest k_max_neighbors instead.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

constexpr std::uint32_t k_max_neighbors = 48;

class NeighborLists {
public:
    /// `points` are distinct and few enough that twice k times their number fits 64 bits; ties are broken
    /// by number. On all threads.
    NeighborLists(std::span<const glm::dvec3> points, std::uint32_t k, const LongCall& call);

    /// By distance, then by number; at most k_max_neighbors.
    std::span<const std::uint32_t> of(std::uint32_t point) const noexcept {
        return std::span(lists_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
    }
    /// How many of of(point), its first, are its own k nearest.
    std::uint32_t nearest_count() const noexcept { return k_; }
    /// How many of of(point), its first, span its surface: k, but all of a row's.
    std::uint32_t spanning_count(std::uint32_t point) const noexcept {
        return is_row_[point] != 0 ? static_cast<std::uint32_t>(of(point).size()) : k_;
    }
    /// One of its k nearest counts it among its own.
    bool is_mutual(std::uint32_t point) const noexcept { return is_mutual_[point] != 0; }

private:
    std::uint32_t k_;
    std::vector<std::uint64_t> begin_;
    std::vector<std::uint32_t> lists_;
    std::vector<std::uint8_t> is_mutual_;
    std::vector<std::uint8_t> is_row_;
};

}  // namespace rimline
