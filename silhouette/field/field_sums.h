#pragma once

// The data that a field sums: planes in clusters, and planes in double for distant points. Selects
// the algorithm for a sum.

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/field/field_kernels.h"
#include "silhouette/field/plane_clusters.h"

namespace rimline {

struct FieldSums {
    struct ExactPlane {
        glm::dvec3 normal;
        double offset;
        double weight;
        double distance(const glm::dvec3& p) const noexcept {
            return (normal.x * p.x + normal.y * p.y + normal.z * p.z) - offset;
        }
    };

    PlaneClusters clusters;
    kernels::FunctionTable function;
    std::vector<ExactPlane> planes;  // In leaf order.
    double budget = 0.0;             // 0: all planes.

    static bool is_near(const glm::dvec3& point) {
        return glm::dot(point, point) <= kernels::k_near_radius * kernels::k_near_radius;
    }
    kernels::FieldScratch make_scratch() const {
        kernels::FieldScratch scratch;
        if (budget > 0.0) scratch.reserve(clusters);
        return scratch;
    }
    /// The sum at a near point, with an error of up to `tolerances` budgets.
    double sum(const kernels::Discount* discount, const glm::dvec3& point,
               kernels::FieldScratch& scratch, kernels::FieldWork& work,
               double tolerances = 1.0) const {
        if (budget > 0.0)
            return kernels::sum_clusters(clusters, function, discount, point, tolerances * budget,
                                         scratch, work);
        work.planes += planes.size();
        return kernels::sum_planes(clusters, function, discount, point);
    }
};

}  // namespace rimline
