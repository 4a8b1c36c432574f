#pragma once

// A field for the next point of interest (thesis 4.2.2): a plane that has already voted for a chosen point
// votes only for what is better,
//
//     D_k(p) = sum_i w_i max(0, f(n_i·p - d_i) - v_i),   v_i = the greatest f among the chosen points,
//
// and before the first is chosen, as in the field itself.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

/// Between two calls of discount, any number of threads may use one.
class DiscountedField {
public:
    /// `field` must outlive it.
    explicit DiscountedField(const TangentialField& field);
    explicit DiscountedField(TangentialField&&) = delete;  // It would be gone.

    /// From now on, votes are for what is better than `chosen`. O(planes).
    void discount(const glm::dvec3& chosen);

    double value(const glm::dvec3& point) const;
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}) const;

    /// No value differs by more from the sum.
    double error_bound() const noexcept;
    const TangentialField& field() const noexcept { return *field_; }

private:
    const TangentialField* field_;
    std::vector<double> previous_;  // By plane; empty before the first point is chosen.
};

}  // namespace rimline
