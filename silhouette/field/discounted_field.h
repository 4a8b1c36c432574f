#pragma once

// A field for the next point of interest (thesis 4.2.2). A plane's vote for a chosen point is subtracted
// from its later votes,
//
//     D_k(p) = sum_i w_i max(0, f(n_i·p - d_i) - v_i),   v_i = the maximum of f at the chosen points.
//
// Before the first point is chosen, it is the field itself.
//
// The field is not C1, so moments of clusters are not sufficient. If all votes of a cluster are below the
// minimum previous vote of its planes, its sum is 0. If all are above the maximum previous vote, its sum
// is reduced by the sum of the previous votes. For other clusters bounds are known. Such a cluster is
// expanded into its parts, unless its bounds are close together.

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

/// Any number of threads may use one object, except during discount().
class DiscountedField {
public:
    /// `field` must outlive this.
    explicit DiscountedField(const TangentialField& field);
    explicit DiscountedField(TangentialField&&) = delete;  // `field` must outlive this.
    ~DiscountedField();
    DiscountedField(DiscountedField&&) noexcept;
    DiscountedField& operator=(DiscountedField&&) noexcept;

    /// Adds `chosen` to the chosen points. O(planes).
    void discount(const glm::dvec3& chosen);

    /// As in TangentialField.
    double value(const glm::dvec3& point) const;
    double value(const glm::dvec3& point, TangentialField::Work& work) const;
    /// With errors of up to `tolerances` times FieldOptions::tolerance.
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}, double tolerances = 1.0) const;

    /// Upper bound of the error of a value.
    double error_bound() const noexcept;
    const TangentialField& field() const noexcept { return *field_; }

private:
    double value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                      kernels::FieldWork& work, double tolerances = 1.0) const;

    const TangentialField* field_;
    // Previous votes by plane, in leaf order. Empty before the first point is chosen.
    std::vector<double> previous_;
    std::unique_ptr<kernels::Discount> discount_;
};

}  // namespace rimline
