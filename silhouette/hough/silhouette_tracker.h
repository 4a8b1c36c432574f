#pragma once

// The silhouette of one mesh from one moving point.
//
// A face turns exactly when the point crosses its plane, so between two frames only the faces whose
// Hough points lie in the active region (thesis 3.4, the symmetric difference of two v-spheres) can
// turn. The tracker finds them in the octree and flips their bits. Of their edges, those change whose
// other face did not flip. When so many faces flip that looking at their edges would cost more than
// finding the silhouette afresh, by the work that both count, it is found afresh and compared.
//
// Which slot an edge has depends on nothing but the points so far: the same on every machine.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_record.h"

namespace rimline {

class SilhouetteTracker {
public:
    /// Extracts the silhouette from `point`. `octree` must outlive the tracker and stay where it is;
    /// many trackers may share one octree across threads. Reserves everything that moves will need: up
    /// to 40 bytes an edge and 20 a face, most of it untouched until a move of that size comes.
    SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point);
    SilhouetteTracker(HoughOctree&&, const HomogeneousPoint&) = delete;  // It would be gone.

    // A copy would have neither the reserve nor spans of its own.
    SilhouetteTracker(SilhouetteTracker&&) noexcept = default;
    SilhouetteTracker& operator=(SilhouetteTracker&&) noexcept = default;

    /// Moves to `point` and reports the difference. Equal, bit for bit, to extracting afresh.
    /// Never allocates. One thread at a time. O(faces near the active region + what changed), and never
    /// much more than a fresh extraction.
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    const Mesh& mesh() const noexcept { return octree_->mesh(); }
    const HomogeneousPoint& point() const noexcept { return record_.change_set().point; }
    /// The sequence of the last change set; 0 before the first move.
    std::uint64_t sequence() const noexcept { return record_.change_set().sequence; }
    /// The silhouette's edges: the slots in use. Valid until the tracker moves.
    std::span<const EdgeId> silhouette() const noexcept { return record_.slots(); }
    std::span<const std::uint32_t> face_words() const noexcept { return record_.face_words(); }
    bool is_front(FaceId face) const noexcept { return face_bit(face_words(), face); }
    /// Work of the extraction at construction.
    const TraversalCounters& construction_counters() const noexcept {
        return construction_counters_;
    }
    /// Memory reserved, the octree's not counted.
    std::uint64_t size_bytes() const noexcept;
    /// Of the last move: whether the silhouette was found afresh.
    bool was_extracted() const noexcept { return was_extracted_; }

private:
    SilhouetteRecord make_record(const HomogeneousPoint& point);
    void toggle_edges(std::span<const std::uint32_t> positions,
                      TraversalCounters& counters) noexcept;

    const HoughOctree* octree_;
    BlockScratch scratch_;
    TraversalCounters construction_counters_;
    TraversalCounters
        extraction_counters_;           // Of the last extraction: what the next one would cost.
    std::vector<std::uint16_t> bits_;   // By block of the octree.
    std::vector<std::uint16_t> flips_;  // By block, one more than there are; zero between moves.
    std::vector<std::uint32_t> positions_;  // Of what flipped; room for all.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> extracted_;
    std::vector<EdgeId> toggled_;  // One more than the most there can be.
    SilhouetteRecord record_;
    bool was_extracted_ = false;
};

}  // namespace rimline
