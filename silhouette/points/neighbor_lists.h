#pragma once

// The neighbors of each point: its k nearest, and all points that have it among their own k nearest.
//
// k nearest neighbors are not mutual. Next to a denser region all k lie on the side of that region, and the
// umbrella seems open on the other side. With mutual neighbors a fifth fewer interior points are taken for
// border points. A point inside a sparse region may be the neighbor of many; the nearest k_max_neighbors are
// kept.
//
// Points may lie in rows, far denser along the row than across. Then most of the k lie in the same row, which
// spans no plane, or a wrong one. Where the directions to the k spread along a line, a point has its nearest
// k_max_neighbors instead.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/unset_vector.h"

namespace rimline {

constexpr std::uint32_t k_max_neighbors = 48;

class NeighborLists {
public:
    /// `points` are distinct, and 2 k times their number fits 64 bits. Of points at equal distance the lower
    /// number comes first. O(n log n) on all threads. Throws Error{cancelled}.
    NeighborLists(std::span<const glm::dvec3> points, std::uint32_t k, const LongCall& call);

    /// At most k_max_neighbors, by distance, then by number.
    std::span<const std::uint32_t> of(std::uint32_t point) const noexcept {
        return std::span(lists_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
    }
    /// The first so many of of(point) are its own k nearest.
    std::uint32_t nearest_count() const noexcept { return k_; }
    /// The first so many of of(point) span its surface: k, or all where the point lies in a row.
    std::uint32_t spanning_count(std::uint32_t point) const noexcept {
        return is_row_[point] != 0 ? static_cast<std::uint32_t>(of(point).size()) : k_;
    }
    /// Whether one of its k nearest has it among its own.
    bool is_mutual(std::uint32_t point) const noexcept { return is_mutual_[point] != 0; }

private:
    std::uint32_t k_;
    std::vector<std::uint64_t> begin_;
    UnsetVector<std::uint32_t> lists_;
    std::vector<std::uint8_t> is_mutual_;
    std::vector<std::uint8_t> is_row_;
};

}  // namespace rimline
