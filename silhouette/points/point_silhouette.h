#pragma once

// The silhouette of a point set from one moving point: which points are on it, and which edges two points
// agree on (thesis 5.3).
//
// The index (umbrella_index.h) names the blocks of patches in which something may change from one viewpoint
// to the next; their face bits are evaluated afresh, and from them their spokes. A spoke that joins or leaves
// counts for its point, and makes or ends a consensus edge where its twin is on the silhouette.
//
// About 8 bytes a point: a byte for its count, a bit a spoke, 5 for walking the tree; and what is on the
// silhouette.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "silhouette/hough/block_set.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/points/umbrella_index.h"

namespace rimline {

class PointSilhouette {
public:
    /// Finds the silhouette from `point`, which `umbrellas` made: viewpoint() or direction(). `umbrellas`
    /// must outlive it and stay where it is.
    PointSilhouette(const UmbrellaIndex& umbrellas, const HomogeneousPoint& point);
    PointSilhouette(UmbrellaIndex&&, const HomogeneousPoint&) = delete;  // It would be gone.

    /// What changed; the spans live until the next move. What joins and leaves again in one move is in
    /// none.
    struct Change {
        std::span<const PointId> added;
        std::span<const PointId> removed;
        TraversalCounters counters;  ///< Work done.
    };
    /// Moves to `point`. What is then on the silhouette equals what finding it afresh would give, exactly.
    /// O(spokes that change + patches near the active region). One thread at a time.
    Change move_to(const HomogeneousPoint& point);

    const HomogeneousPoint& point() const noexcept { return point_; }
    const UmbrellaIndex& umbrellas() const noexcept { return *umbrellas_; }
    bool contains(PointId point) const noexcept {
        const std::uint32_t patch = umbrellas_->patch_of(point);
        return patch != UmbrellaIndex::k_none && spoke_counts_[patch] > 0;
    }
    std::uint32_t size() const noexcept { return size_; }
    /// Ascending. O(points).
    std::vector<PointId> points() const;
    /// The edges that are on the silhouette in the patches of both their points, each once, in no order.
    /// Valid until the next move.
    std::span<const PointEdge> consensus() const noexcept { return consensus_; }
    /// The same, ascending. O(edges log edges).
    std::vector<PointEdge> consensus_edges() const;
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

private:
    void update_block(std::uint32_t block, TraversalCounters& counters);
    void update_fan(std::uint32_t patch, std::uint32_t first_spoke, std::uint32_t size,
                    const std::uint8_t* front);
    void update_spokes(std::uint32_t patch, const std::uint8_t* front);
    void toggle(std::uint32_t patch, std::uint32_t spoke);
    void join_consensus(std::uint32_t spoke, const PointEdge& edge);
    void leave_consensus(std::uint32_t spoke);
    bool is_on(std::uint32_t spoke) const noexcept {
        return (on_bits_[spoke / 8] >> spoke % 8 & 1u) != 0;
    }

    const UmbrellaIndex* umbrellas_;
    HomogeneousPoint point_;
    BlockScratch scratch_;
    std::vector<std::uint8_t> front_;         // Of the planes of a block.
    std::vector<std::uint8_t> spoke_counts_;  // Of each patch, its spokes on the silhouette.
    std::vector<std::uint8_t> on_bits_;       // A bit a spoke.
    std::uint32_t size_ = 0;
    // Of each edge the lesser of its two spokes, and where that is.
    std::vector<PointEdge> consensus_;
    std::vector<std::uint32_t> consensus_spokes_;
    std::unordered_map<std::uint32_t, std::uint32_t> consensus_slots_;
    std::vector<PointId> added_;
    std::vector<PointId> removed_;
};

/// The edges as polylines, each edge once: from a point that has not two edges along points that have to
/// the next, then closed loops, whose first point is also their last. O(edges log edges).
std::vector<std::vector<PointId>> chain(std::span<const PointEdge> edges);

}  // namespace rimline
