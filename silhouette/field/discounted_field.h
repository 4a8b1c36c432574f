#pragma once

// A field for the next point of interest (thesis 4.2.2): a plane that has already voted for a chosen point
// votes only for what is better,
//
//     D_k(p) = sum_i w_i max(0, f(n_i·p - d_i) - v_i),   v_i = the greatest f among the chosen points,
//
// and before the first is chosen, as in the field itself.
//
// Not C1, so moments alone would not do. A cluster whose votes cannot exceed the least previous vote of its
// planes has none; one whose votes all exceed the greatest has its sum less the sum of the previous
// votes; of a mixed one the bounds are known, and it is opened unless they lie close together.

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

namespace kernels {
struct Discount;
}  // namespace kernels

/// Between two calls of discount, any number of threads may use one.
class DiscountedField {
public:
    /// `field` must outlive it.
    explicit DiscountedField(const TangentialField& field);
    explicit DiscountedField(TangentialField&&) = delete;  // It would be gone.
    ~DiscountedField();
    DiscountedField(DiscountedField&&) noexcept;
    DiscountedField& operator=(DiscountedField&&) noexcept;

    /// From now on, votes are for what is better than `chosen`. O(planes).
    void discount(const glm::dvec3& chosen);

    /// As TangentialField's.
    double value(const glm::dvec3& point) const;
    double value(const glm::dvec3& point, TangentialField::Work& work) const;
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}) const;

    /// No value differs by more from the sum.
    double error_bound() const noexcept;
    const TangentialField& field() const noexcept { return *field_; }

private:
    double value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                      kernels::FieldWork& work) const;

    const TangentialField* field_;
    std::vector<double>
        previous_;  // By plane in leaf order; empty before the first point is chosen.
    std::unique_ptr<kernels::Discount> discount_;
};

}  // namespace rimline
