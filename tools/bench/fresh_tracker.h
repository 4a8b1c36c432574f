#pragma once

// A fresh tracker for every frame, with the change set that leads there: what one has with the octree
// and no updates. The worst update is measured against it.
//
// All face bits from the octree's blocks, those that differ from the last frame's flipped, the
// silhouette by the octree's static extraction, and what joined and left by comparing it with the last
// (SilhouetteRecord::replace_edges). Nothing is allocated or reserved anew, as a tracker's construction
// would have to: the comparison is with the work alone.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_record.h"

namespace rimline::tools {

class FreshTracker {
public:
    /// `octree` must outlive it.
    FreshTracker(const HoughOctree& octree, const HomogeneousPoint& point);

    const ChangeSet& move_to(const HomogeneousPoint& point);

    std::span<const EdgeId> silhouette() const noexcept { return record_.slots(); }
    std::span<const std::uint32_t> face_words() const noexcept { return record_.face_words(); }

private:
    SilhouetteRecord make_record(const HomogeneousPoint& point);

    const HoughOctree* octree_;
    BlockScratch scratch_;
    std::vector<std::uint16_t> bits_;      // By block of the octree.
    std::vector<std::uint16_t> new_bits_;  // Of the point moved to.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> extracted_;
    SilhouetteRecord record_;
};

}  // namespace rimline::tools
