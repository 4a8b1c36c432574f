#pragma once

// The silhouette of a point set from one moving point: which points are on it, and which edges are on it by
// consensus of both their points (thesis 5.3).
//
// The index (umbrella_index.h) lists the blocks of patches in which something may change from one viewpoint
// to the next. Their face bits are evaluated again, and from these their spokes. Each point counts its spokes
// on the silhouette. A spoke that joins or leaves adds or removes a consensus edge where its twin is on the
// silhouette.
//
// Memory: about 8 bytes a point (a byte for its count, a bit for each spoke, 5 bytes for tree traversal), and
// the elements on the silhouette.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/points/umbrella_index.h"

namespace rimline {

class PointSilhouette {
public:
    /// Finds the silhouette from `point`, a result of umbrellas.viewpoint() or direction(). `umbrellas` must
    /// outlive the object and must not be moved.
    PointSilhouette(const UmbrellaIndex& umbrellas, const HomogeneousPoint& point);
    PointSilhouette(UmbrellaIndex&&,
                    const HomogeneousPoint&) = delete;  // A temporary would dangle.

    /// What changed. The spans are valid until the next move. A point that joins and leaves again in one move
    /// is in neither.
    struct Change {
        std::span<const PointId> added;
        std::span<const PointId> removed;
        TraversalCounters counters;  ///< Work done.
    };
    /// Moves to `point`. The result equals that of a new object, exactly.
    /// O(spokes that change + patches near the active region). One thread at a time. Throws std::bad_alloc: the
    /// silhouette is then to be asked for nothing but point(), which is that before the call, until another move
    /// succeeds, which is O(points) and reports what changed from there.
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
    /// The edges that are on the silhouette in the patches of both their points: each once, unordered.
    /// Valid until the next move.
    std::span<const PointEdge> consensus() const noexcept { return consensus_; }
    /// The same, ascending. O(edges log edges).
    std::vector<PointEdge> consensus_edges() const;
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

private:
    void find_all();
    void update_block(std::uint32_t block, const HomogeneousPoint& point,
                      TraversalCounters& counters);
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
    std::vector<std::uint8_t> front_;         // Face bits of the planes of a block, as bytes.
    std::vector<std::uint8_t> spoke_counts_;  // For each patch, its spokes on the silhouette.
    std::vector<std::uint8_t> on_bits_;       // One bit for each spoke.
    std::uint32_t size_ = 0;
    bool is_torn_ = true;  // A move began and did not end: counts, bits and edges are of no point.
    // For each edge the lesser of its two spokes, and the slot of the edge by that spoke.
    std::vector<PointEdge> consensus_;
    std::vector<std::uint32_t> consensus_spokes_;
    std::unordered_map<std::uint32_t, std::uint32_t> consensus_slots_;
    std::vector<PointId> added_;
    std::vector<PointId> removed_;
};

/// The edges as polylines, each edge once. First the lines between points that do not have exactly two edges,
/// along points that have two. Then the closed loops, whose first point is also their last. O(edges log
/// edges).
std::vector<std::vector<PointId>> chain(std::span<const PointEdge> edges);

}  // namespace rimline
