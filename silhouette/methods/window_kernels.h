#pragma once

// The inner loops of WindowedBruteForce, compiled for every instruction set that Highway knows for the target.

#include <cstdint>
#include <span>

#include "silhouette/methods/windowed_edges.h"

namespace rimline::kernels {

/// Writes what each window's bits show.
void find_sides(std::span<const std::uint16_t> bits, std::span<WindowSides> sides);

/// Writes the edges whose faces' bits differ to `out`, which must hold a group more than there can be. Returns the end.
/// `found` has one for each group.
EdgeId* find_window_edges(const WindowedEdges& windowed, std::span<const std::uint16_t> bits,
                          std::span<const WindowSides> sides, std::span<FoundEdges> found,
                          EdgeId* out);

}  // namespace rimline::kernels
