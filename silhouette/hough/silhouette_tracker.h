#pragma once

// The silhouette of one mesh from one moving point.
//
// A face turns exactly when the point crosses its plane. So between two frames only those faces can turn
// whose Hough points lie in the active region (thesis 3.4, the symmetric difference of two v-spheres). The
// tracker finds them in the octree and flips their bits. Of their edges, those change whose other face did
// not flip. When many faces flip, the estimated cost of testing their edges may exceed that of an extraction.
// Then the silhouette is extracted again and compared with the last one.
//
// The slot of an edge depends only on the sequence of points. It is the same on every machine.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

class SilhouetteRecord;

class SilhouetteTracker {
public:
    /// Extracts the silhouette from `point`. `octree` must outlive the tracker and must not be moved. Many
    /// trackers may share one octree across threads. Reserves all memory that moves need: up to 40 bytes an
    /// edge and 10 a face. Most of it is not touched until a move of that size.
    SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point);
    SilhouetteTracker(HoughOctree&&,
                      const HomogeneousPoint&) = delete;  // A temporary would dangle.

    // No copies: a copy's change set would refer to the original, and its memory would not be reserved.
    SilhouetteTracker(SilhouetteTracker&&) noexcept;
    SilhouetteTracker& operator=(SilhouetteTracker&&) noexcept;
    ~SilhouetteTracker();

    /// Moves to `point` and returns the difference. The result equals an extraction, bit for bit.
    /// Never allocates. One thread at a time. O(faces near the active region + changes), and never much more
    /// than an extraction.
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    const Mesh& mesh() const noexcept { return octree_->mesh(); }
    const HomogeneousPoint& point() const noexcept;
    /// The sequence of the last change set; 0 before the first move.
    std::uint64_t sequence() const noexcept;
    /// The silhouette's edges: the slots in use. Valid until the tracker moves.
    std::span<const EdgeId> silhouette() const noexcept;
    std::span<const std::uint32_t> face_words() const noexcept;
    bool is_front(FaceId face) const noexcept { return face_bit(face_words(), face); }
    /// Work of the extraction at construction.
    const TraversalCounters& construction_counters() const noexcept {
        return construction_counters_;
    }
    /// Memory reserved, the octree's not counted.
    std::uint64_t size_bytes() const noexcept;
    /// Whether the last move extracted the silhouette again.
    bool was_extracted() const noexcept { return was_extracted_; }

private:
    const HoughOctree* octree_;
    BlockScratch scratch_;
    TraversalCounters construction_counters_;
    // Of the last extraction: estimates the cost of the next.
    TraversalCounters extraction_counters_;
    // By block of the octree, and one more for faces without a plane: the bits of its faces, and from bit 16 on
    // which of them flipped. These are zero between moves.
    std::vector<std::uint32_t> states_;
    std::vector<FlippedBlock> flipped_blocks_;
    std::vector<std::uint32_t> positions_;  // Of flipped faces.
    std::vector<EdgeId> extracted_;
    std::unique_ptr<SilhouetteRecord> record_;
    bool was_extracted_ = false;
};

}  // namespace rimline
