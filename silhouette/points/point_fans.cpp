#include "silhouette/points/point_fans.h"

#include <algorithm>

namespace rimline {

std::uint64_t ring_places(const Fan& fan) noexcept {
    std::uint64_t places = 0;
    for (std::size_t j = 0; j < fan.size; ++j) places |= std::uint64_t{1} << fan.ring[j];
    return places;
}

std::uint64_t gap_ends(const Fan& fan) noexcept {
    std::uint64_t places = 0;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (fan.is_gap(j))
            places |= std::uint64_t{1} << fan.ring[j] | std::uint64_t{1} << fan.ring[fan.next(j)];
    return places;
}

std::uint64_t open_ends(const PointFans& fans) noexcept {
    std::uint64_t places = 0;
    for (const Fan& fan : fans.all()) places ^= gap_ends(fan);
    return places;
}

bool is_smallest(const Fan& whole, std::span<const Fan> others) noexcept {
    return !others.empty() &&
           std::ranges::all_of(others, [&](const Fan& other) { return other.size > whole.size; });
}

}  // namespace rimline
