#pragma once

// Brute force (windowed_brute_force.h) and its tracker (brute_force_tracker.h) as a method.

#include <optional>

#include "silhouette/methods/brute_force_tracker.h"
#include "silhouette/methods/silhouette_method.h"
#include "silhouette/methods/windowed_brute_force.h"

namespace rimline {

class BruteForceMethod final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit BruteForceMethod(const Mesh& mesh) : mesh_(&mesh), brute_force_(mesh) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    const Mesh* mesh_;
    WindowedBruteForce brute_force_;
    std::optional<BruteForceTracker> tracker_;  // Made by the first update.
};

}  // namespace rimline
