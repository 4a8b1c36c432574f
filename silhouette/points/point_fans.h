#pragma once

// The umbrellas of one point while the passes of the thesis make them (thesis_umbrellas.h). A set of neighbors
// is a number: its bit i is place i of the point's neighbor list.

#include <array>
#include <cstdint>
#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

struct PointFans {
    static constexpr std::size_t k_max_fans = 4;
    std::array<Fan, k_max_fans> fans;
    std::uint8_t count = 0;

    std::span<const Fan> all() const noexcept { return std::span(fans).first(count); }
    /// Whether it is one umbrella without boundary.
    bool is_whole() const noexcept { return count == 1 && fans[0].gaps == 0; }
    void set(const Fan& fan) noexcept {
        fans[0] = fan;
        count = 1;
    }
};

/// The neighbors in the ring.
std::uint64_t ring_places(const Fan& fan) noexcept;
/// The boundary edges of an umbrella: both ends of each gap.
std::uint64_t gap_ends(const Fan& fan) noexcept;
/// The open boundary edges of a point: those on the boundary of exactly one of its umbrellas. The other
/// boundary edges are shared. No edge is on more than two boundaries.
std::uint64_t open_ends(const PointFans& fans) noexcept;

/// Whether an umbrella without boundary has fewer points than each of the others: then it is dropped, else it
/// replaces them (thesis 5.2.4). False without others.
bool is_smallest(const Fan& whole, std::span<const Fan> others) noexcept;

}  // namespace rimline
