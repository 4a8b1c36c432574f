#pragma once

// Codes of three whole coordinates whose bits take turns: Morton's order, and the last step of Hilbert's.
//
//     .. z1 y1 x1 z0 y0 x0

#include <cstdint>

namespace rimline {

/// Bit b becomes bit 3 b. The lowest 21 bits of `bits`; the others must be zero.
constexpr std::uint64_t spread_bits(std::uint64_t bits) noexcept {
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

/// Of up to 21 bits each, `x` lowest.
constexpr std::uint64_t interleaved_bits(std::uint64_t x, std::uint64_t y,
                                         std::uint64_t z) noexcept {
    return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

}  // namespace rimline
