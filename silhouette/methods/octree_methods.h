#pragma once

// The two octrees over Hough space as methods: the index (hough_octree.h) and the thesis's own
// (literal/literal_octree.h), each with the tracker that follows a moving point in it.

#include <optional>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/methods/literal/literal_octree.h"
#include "silhouette/methods/literal/literal_tracker.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class OctreeMethod final : public SilhouetteMethod {
public:
    OctreeMethod(const Mesh& mesh, const HoughOctreeOptions& options, const LongCall& call)
        : octree_(mesh, options, call), scratch_(octree_.make_scratch()) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    HoughOctree octree_;
    BlockScratch scratch_;
    std::optional<SilhouetteTracker> tracker_;  // From the first update on.
};

class LiteralMethod final : public SilhouetteMethod {
public:
    LiteralMethod(const Mesh& mesh, const LiteralOctreeOptions& options) : octree_(mesh, options) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;
    std::vector<NamedCount> own_counts() const override;

private:
    void take(const LiteralCounters& work, TraversalCounters& counters);

    LiteralOctree octree_;
    std::optional<LiteralTracker> tracker_;  // From the first update on.
    LiteralCounters work_;                   // Of the last call.
};

}  // namespace rimline
