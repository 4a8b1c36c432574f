#pragma once

// Brute force as methods: every face and every edge, one by one (brute_force.h) or packed
// (brute_force_packed.h), which follows a moving point as well (brute_force_tracker.h).

#include <optional>

#include "silhouette/methods/brute_force_packed.h"
#include "silhouette/methods/brute_force_tracker.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class ScalarBruteForceMethod final : public SilhouetteMethod {
public:
    explicit ScalarBruteForceMethod(const Mesh& mesh) : mesh_(&mesh) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;

private:
    const Mesh* mesh_;
};

class PackedBruteForceMethod final : public SilhouetteMethod {
public:
    explicit PackedBruteForceMethod(const Mesh& mesh) : mesh_(&mesh), brute_force_(mesh) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    const Mesh* mesh_;
    PackedBruteForce brute_force_;
    std::vector<std::uint32_t> words_;
    std::optional<BruteForceTracker> tracker_;  // From the first update on.
};

}  // namespace rimline
