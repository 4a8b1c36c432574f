#pragma once

// Scalar brute force (brute_force.h) as a method: every face and every edge, one by one.

#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class ScalarBruteForceMethod final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit ScalarBruteForceMethod(const Mesh& mesh) : mesh_(&mesh) {}

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override {
        RIMLINE_CHECK(point.is_valid());
        edges = brute_force_silhouette(*mesh_, point);
        counters.face_checks += mesh_->face_count();
        counters.edge_checks += mesh_->edge_count();
    }

private:
    const Mesh* mesh_;
};

}  // namespace rimline
