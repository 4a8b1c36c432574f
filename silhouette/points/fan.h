#pragma once

// A packed Umbrella, for use while umbrellas are found: the ring as places in the point's neighbor list, in
// cyclic order, and which sectors are gaps.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/points/neighbor_lists.h"
#include "silhouette/points/umbrella.h"

namespace rimline {

struct Fan {
    std::uint64_t gaps = 0;
    std::uint8_t size = 0;
    std::array<std::uint8_t, k_max_neighbors> ring;

    std::size_t next(std::size_t j) const noexcept { return j + 1 == size ? 0 : j + 1; }
    std::size_t previous(std::size_t j) const noexcept { return (j == 0 ? size : j) - 1u; }
    bool is_gap(std::size_t sector) const noexcept { return (gaps >> sector & 1u) != 0; }
    void open(std::size_t sector) noexcept { gaps |= std::uint64_t{1} << sector; }
    /// Whether it has a triangle.
    bool is_umbrella() const noexcept {
        return size >= 2 && gaps != (std::uint64_t{1} << size) - 1;
    }
};

/// Joins gaps that follow each other: removes the ring points between them.
void merge_gaps(Fan& fan) noexcept;
/// Reverses the order of the ring.
void reverse(Fan& fan) noexcept;

/// The umbrellas of all points, numbered as in OrderedPoints.
struct UmbrellaSet {
    struct Supplement {
        std::uint32_t point;
        Fan fan;
        glm::dvec3 normal;
    };
    std::vector<Fan> fans;  ///< The first of each point; without triangles where it has none.
    std::vector<glm::dvec3> normals;  ///< Of each fan.
    std::vector<double> scales;       ///< Of each point.
    std::vector<PointLabel> labels;
    std::vector<UndecidedReason> reasons;
    std::vector<Supplement> supplements;  ///< Further umbrellas, by point.
};

}  // namespace rimline
