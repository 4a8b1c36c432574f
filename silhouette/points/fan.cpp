#include "silhouette/points/fan.h"

namespace rimline {

void merge_gaps(Fan& fan) noexcept {
    std::uint8_t size = 0;
    std::uint64_t gaps = 0;
    for (std::size_t j = 0; j < fan.size; ++j) {
        if (fan.is_gap(j) && fan.is_gap(fan.previous(j))) continue;
        gaps |= std::uint64_t{fan.is_gap(j)} << size;
        fan.ring[size++] = fan.ring[j];
    }
    fan.size = size;
    fan.gaps = gaps;
}

void reverse(Fan& fan) noexcept {
    // The sector that ended at ring[from] begins at turned.ring[j].
    Fan turned;
    turned.size = fan.size;
    for (std::size_t j = 0; j < fan.size; ++j) {
        const std::size_t from = fan.size - 1u - j;
        turned.ring[j] = fan.ring[from];
        if (fan.is_gap(fan.previous(from))) turned.open(j);
    }
    fan = turned;
}

}  // namespace rimline
