#pragma once

// The thesis's own octree over Hough space (literal/literal_octree.h) and its tracker as a method.

#include <optional>

#include "silhouette/methods/literal/literal_octree.h"
#include "silhouette/methods/literal/literal_tracker.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class LiteralMethod final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    LiteralMethod(const Mesh& mesh, const LiteralOctreeOptions& options) : octree_(mesh, options) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;
    std::vector<NamedCount> own_counts() const override;

private:
    void take(const LiteralCounters& work, TraversalCounters& counters);

    LiteralOctree octree_;
    std::optional<LiteralTracker> tracker_;  // Made by the first update.
    LiteralCounters work_;                   // Of the last call.
};

}  // namespace rimline
