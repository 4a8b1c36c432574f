#pragma once

// Brute force as fast as it gets: the baseline that an index is compared with.
//
// It tests every face, and every edge that can be on the silhouette by its faces' neighborhoods:
//
//   Faces lie in the order of a Hilbert curve through their centroids, their planes in steps of 16 bits
//     (plane_block.h): half the memory of floats. Sixteen bits are decided at a time, doubtful ones exactly.
//   A window holds the bits of 256 faces that follow each other, 32 bytes in vector registers. Of an edge's two faces
//     nearly always both lie in one window (seven of eight), or else in two windows that many edges have in common.
//     So edges are stored by pairs of windows, as four bytes each: the byte and the bit of either face. Byte shuffles
//     look 32 edges up at once, where a gather has to read each word from memory.
//   Where both windows of a pair have only fronts, or only backs, its edges are skipped.
//
// The results equal those of brute_force.h.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/hough/block_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/windowed_edges.h"

namespace rimline {

/// One thread at a time.
class WindowedBruteForce {
public:
    /// `mesh` must outlive this object. Uses about 20 bytes a face and 15 an edge. O(n log n).
    explicit WindowedBruteForce(const Mesh& mesh);
    explicit WindowedBruteForce(Mesh&&) = delete;  // It would dangle.

    /// Decides all faces. Never allocates. O(faces).
    void look_from(const HomogeneousPoint& point) noexcept;
    /// Replaces `edges` by the silhouette from the last look_from(), in no particular order. O(edges).
    void silhouette(std::vector<EdgeId>& edges);

    /// One bit for each place in the order: bit p % 16 of word p / 16. Of the last look_from().
    std::span<const std::uint16_t> bits() const noexcept { return bits_; }
    FaceId face_at(std::uint32_t place) const noexcept { return order_[place]; }
    /// The place of each face.
    std::span<const std::uint32_t> places() const noexcept { return places_; }

private:
    void place_faces();
    void place_edges();
    bool is_front_at(FaceId face) const noexcept;

    const Mesh* mesh_;
    std::vector<FaceId> order_;  // Faces without a normal, which are always back, come last.
    std::vector<std::uint32_t> places_;
    FaceBlocks blocks_;
    BlockScratch scratch_;
    std::vector<std::uint16_t> bits_;  // Whole windows.
    std::vector<WindowSides> sides_;
    WindowedEdges edges_;
    std::vector<FoundEdges> found_;   // One for each group.
    std::vector<EdgeId> silhouette_;  // One group more than there are edges.
};

}  // namespace rimline
