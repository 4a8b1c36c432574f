#pragma once

// The silhouette of one mesh from one moving point.
//
// A face turns exactly when the point crosses its plane, so between two frames only the faces whose
// Hough points lie in the active region (thesis 3.4, the symmetric difference of two v-spheres) can
// turn. The tracker finds them in the octree, flips their bits, and re-examines their edges only.

#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

class SilhouetteTracker {
public:
    /// Extracts the silhouette from `point`. `octree` must outlive the tracker; many trackers may
    /// share one octree across threads. Reserves everything that moves will need.
    SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point);

    /// Moves to `point` and reports the difference. Equal, bit for bit, to extracting afresh.
    /// Never allocates. One thread at a time.
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    const Mesh& mesh() const noexcept;
    const HomogeneousPoint& point() const noexcept;
    /// The sequence of the last change set; 0 before the first move.
    std::uint64_t sequence() const noexcept;
    /// The silhouette's edges: the slots in use.
    std::span<const EdgeId> silhouette() const noexcept;
    std::span<const std::uint32_t> face_words() const noexcept;
    bool is_front(FaceId face) const noexcept;
    /// Work of the extraction at construction.
    const TraversalCounters& construction_counters() const noexcept;
};

}  // namespace rimline
