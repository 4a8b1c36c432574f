#pragma once

// The octree over Hough space (hough_octree.h) and its tracker as a method.

#include <optional>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class OctreeMethod final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    OctreeMethod(const Mesh& mesh, const HoughOctreeOptions& options, const LongCall& call)
        : octree_(mesh, options, call), scratch_(octree_.make_scratch()) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override {
        octree_.extract(point, edges, counters, scratch_);
    }
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override {
        if (tracker_)
            counters += tracker_->move_to(point).counters;
        else
            counters += tracker_.emplace(octree_, point).construction_counters();
        edges.assign(tracker_->silhouette().begin(), tracker_->silhouette().end());
    }

private:
    HoughOctree octree_;
    BlockScratch scratch_;
    std::optional<SilhouetteTracker> tracker_;  // Made by the first update.
};

}  // namespace rimline
