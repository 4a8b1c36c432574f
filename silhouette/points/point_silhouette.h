#pragma once

// The silhouette of a point set from one moving point: which points are on it, and which edges two points
// agree on (thesis 5.3).
//
// A tracker follows the patches of all points (umbrella_index.h); its change sets say which spokes joined
// and left; counting them by point says which points did, and looking at their twins which consensus edges.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/points/umbrella_index.h"

namespace rimline {

/// Two points, the lesser first.
using PointEdge = std::array<PointId, 2>;

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
    /// O(spokes that change + faces near the active region). One thread at a time.
    Change move_to(const HomogeneousPoint& point);

    const HomogeneousPoint& point() const noexcept { return tracker_.point(); }
    const UmbrellaIndex& umbrellas() const noexcept { return *umbrellas_; }
    bool contains(PointId point) const noexcept { return spoke_counts_[index(point)] > 0; }
    std::uint32_t size() const noexcept { return size_; }
    /// Ascending. O(points).
    std::vector<PointId> points() const;
    /// The edges that are on the silhouette in the patches of both their points, each once, in no order.
    /// Valid until the next move.
    std::span<const PointEdge> consensus() const noexcept { return consensus_; }
    /// The same, ascending. O(edges log edges).
    std::vector<PointEdge> consensus_edges() const;

private:
    void count_spokes(std::span<const EdgeId> edges, int step);
    void join_consensus(std::uint32_t spoke, std::uint32_t twin);
    void leave_consensus(std::uint32_t spoke, std::uint32_t twin);

    const UmbrellaIndex* umbrellas_;
    SilhouetteTracker tracker_;
    std::vector<std::uint8_t> spoke_counts_;  // Of each point, its spokes on the silhouette.
    std::vector<std::uint8_t> is_on_;         // Of each spoke.
    std::uint32_t size_ = 0;
    std::vector<PointEdge> consensus_;
    std::vector<std::uint32_t>
        consensus_spokes_;  // Of each edge there, the lesser of its two spokes.
    std::vector<std::uint32_t> consensus_slots_;  // Of each such spoke, where its edge is.
    std::vector<std::uint8_t> was_on_;  // Of each point touched in a move; 0xff for all others.
    std::vector<PointId> touched_;
    std::vector<PointId> added_;
    std::vector<PointId> removed_;
};

/// The edges as polylines, each edge once: from a point that has not two edges along points that have to
/// the next, then closed loops, whose first point is also their last. O(edges log edges).
std::vector<std::vector<PointId>> chain(std::span<const PointEdge> edges);

}  // namespace rimline
