#pragma once

// A fresh extraction for every frame, with the change set to the new state: the octree without updates. The
// worst update is compared with it.
//
// All face bits from the octree's blocks, those that differ from the last frame's flipped, the
// silhouette by the octree's static extraction, the added and removed edges by a comparison with the last
// silhouette (SilhouetteRecord::replace_edges). Nothing is allocated in a frame, so that only the work is
// compared.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_record.h"

namespace rimline::tools {

class FreshTracker {
public:
    /// `octree` must outlive this object.
    FreshTracker(const HoughOctree& octree, const HomogeneousPoint& point);

    const ChangeSet& move_to(const HomogeneousPoint& point);

    std::span<const EdgeId> silhouette() const noexcept { return record_.slots(); }
    std::span<const std::uint32_t> face_words() const noexcept { return record_.face_words(); }

private:
    SilhouetteRecord make_record(const HomogeneousPoint& point);

    const HoughOctree* octree_;
    BlockScratch scratch_;
    std::vector<std::uint16_t> bits_;      // One a block of the octree.
    std::vector<std::uint16_t> new_bits_;  // Of the new point.
    std::vector<EdgeId> extracted_;
    SilhouetteRecord record_;
};

}  // namespace rimline::tools
