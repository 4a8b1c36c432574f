#pragma once

// How trackers find the edges that change: from the links between neighboring faces, and the state of each face.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The edges of a face that have two faces, and the other face of each.
struct FaceLinks {
    /// The number of an edge. With k_turned where both faces traverse it in the same direction: it is on the
    /// silhouette where their bits are equal.
    std::array<std::uint32_t, 3> edges;
    /// The place of the other face: its block times 32, and its lane. For a border or a non-manifold edge, which
    /// has edge 0, that of the face itself.
    std::array<std::uint32_t, 3> places;

    static constexpr std::uint32_t k_turned = 0x80000000u;
    static constexpr std::uint32_t place_of(std::uint32_t position) noexcept {
        return position / k_block_size * 32 + position % k_block_size;
    }
    /// The links of `face`. `position_of` holds the positions of all faces.
    FaceLinks(const Mesh& mesh, FaceId face, std::span<const std::uint32_t> position_of) noexcept;
    FaceLinks() = default;
};

/// The flipped faces of a move, as positions with the face's new bit as the highest.
constexpr std::uint32_t k_front_position = 0x80000000u;

/// Of an edge that changes: it is on the silhouette now.
constexpr std::uint32_t k_joins = 0x80000000u;

/// Writes to `toggled` the edges of the faces at `positions` whose other face did not flip, with k_joins where
/// they are on the silhouette now, and returns their number. `toggled` must have space for one more than there are.
/// `states` has a word for each block: the new bits of its faces, and from bit 16 on which of them flipped.
/// O(positions).
std::size_t find_toggled_edges(std::span<const std::uint32_t> positions,
                               std::span<const FaceLinks> links,
                               std::span<const std::uint32_t> states,
                               std::uint32_t* toggled) noexcept;

}  // namespace rimline
