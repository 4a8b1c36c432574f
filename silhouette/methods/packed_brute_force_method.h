#pragma once

// Packed brute force (brute_force_packed.h) and its tracker (brute_force_tracker.h) as a method.

#include <optional>

#include "silhouette/methods/brute_force_packed.h"
#include "silhouette/methods/brute_force_tracker.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class PackedBruteForceMethod final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit PackedBruteForceMethod(const Mesh& mesh) : mesh_(&mesh), brute_force_(mesh) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    const Mesh* mesh_;
    PackedBruteForce brute_force_;
    std::vector<std::uint32_t> words_;
    std::optional<BruteForceTracker> tracker_;  // Made by the first update.
};

}  // namespace rimline
