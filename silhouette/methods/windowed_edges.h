#pragma once

// Edges by the windows in which the bits of their faces lie, for windowed_brute_force.h.

#include <array>
#include <cstdint>
#include <vector>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/mesh/ids.h"

namespace rimline {

constexpr std::uint32_t k_window_faces = 256;
constexpr std::uint32_t k_window_blocks = k_window_faces / k_block_size;
constexpr std::uint32_t k_window_edges = 32;  ///< Of a group: looked up at once.

/// What the faces of a window show.
enum class WindowSides : std::uint8_t { backs, fronts, both };

/// The faces of 32 edges. A byte's number is below 16, or with the top bit set, for the second half of a window, from
/// 128 on. Lanes without an edge have the same face twice.
struct alignas(64) EdgeGroup {
    std::array<std::uint8_t, k_window_edges> byte_a, bit_a, byte_b, bit_b;
};

/// Edges between the faces of two windows: groups [first, last).
struct WindowPair {
    std::uint32_t window_a, window_b;
    std::uint32_t first, last;
};

struct WindowedEdges {
    std::vector<WindowPair> pairs;
    std::vector<EdgeGroup> groups;
    std::vector<EdgeId> ids;  ///< 32 for each group.
};

/// The lanes of a group whose bits differ.
struct FoundEdges {
    std::uint32_t group, lanes;
};

}  // namespace rimline
