#pragma once

// Finds equal positions. Coordinates are compared as numbers: -0 equals 0. Uses a hash table with
// open addressing, at most half full.

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <type_traits>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// For each position, the first index with an equal position. Takes at most 2^32 - 2 positions,
/// none of them NaN. O(positions) expected. Throws Error{cancelled}.
template <typename Real>
std::vector<std::uint32_t> first_equal_positions(
    std::span<const std::type_identity_t<glm::vec<3, Real>>> positions,
    const std::stop_token& stop = {}) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    const auto hash_of = [](const glm::vec<3, Real>& p) {
        std::uint64_t h = 0;
        for (int axis = 0; axis < 3; ++axis) {
            h = (h + std::bit_cast<Bits>(p[axis] + Real{0})) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        return static_cast<std::size_t>(h * 0xd6e8feb86659fd93u >> 16);
    };
    constexpr std::uint32_t k_free = 0xffffffffu;
    const std::size_t capacity = std::bit_ceil(positions.size() * 2 + 1);
    std::vector<std::uint32_t> table(capacity, k_free);
    std::vector<std::uint32_t> first(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        if (i % (1u << 16) == 0) LongCall{stop, {}}.checkpoint(0.0);
        std::size_t slot = hash_of(positions[i]) & (capacity - 1);
        while (table[slot] != k_free && positions[table[slot]] != positions[i])
            slot = (slot + 1) & (capacity - 1);
        if (table[slot] == k_free) table[slot] = i;
        first[i] = table[slot];
    }
    return first;
}

}  // namespace rimline
