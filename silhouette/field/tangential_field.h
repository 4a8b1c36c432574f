#pragma once

// The tangential distance field of a mesh (thesis 4.1): at a point p, the sum of what its planes vote,
//
//     D(p) = sum_i w_i f(n_i·p - d_i)                                                            (4.1)
//
// with f a tangential distance function and w_i 1 or the area of the plane's face (6.4.2). Points are in
// unit coordinates (unit_planes.h).
//
// Planes that lie close together are summed together (plane_clusters.h) where that costs no more than the
// tolerance, with a bound that holds everywhere (field_kernels.h). What errors come out is less: on igea a
// fortieth of the tolerance, since bounds add up and errors cancel. docs/field.md has the figures.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>

#include "silhouette/error.h"
#include "silhouette/field/tangential_function.h"
#include "silhouette/field/unit_planes.h"

namespace rimline {

namespace kernels {
struct FieldScratch;
struct FieldWork;
}  // namespace kernels

struct FieldSums;  // field_sums.h

struct FieldOptions {
    /// Of every value, as a share of the greatest that a value can be (greatest_value). 0: all planes are
    /// summed, in float. Float's rounding comes on top of it, see error_bound.
    double tolerance = 1e-3;
    enum class Weight : std::uint8_t { count, area } weight = Weight::count;
};

/// Immutable: any number of threads may use one. Keeps nothing of the planes.
class TangentialField {
public:
    /// The function has 32 knots or fewer (RIMLINE_CHECK). O(planes log planes) on all threads.
    TangentialField(const UnitPlanes& planes, const TangentialFunction& function,
                    const FieldOptions& options = {});
    ~TangentialField();
    TangentialField(TangentialField&&) noexcept;
    TangentialField& operator=(TangentialField&&) noexcept;

    /// Points are finite (RIMLINE_CHECK). Farther than 4 from the center, all planes are summed in double.
    double value(const glm::dvec3& point) const;
    /// One for each point, on all threads that oneTBB gives; the same whatever their number, and the same
    /// as value's. (Sums differ by rounding between instruction sets.) A cancelled `call` throws
    /// Error{cancelled}.
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}) const;
    /// Of the exact sum, in double. O(planes).
    glm::dvec3 gradient(const glm::dvec3& point) const;

    /// No value differs by more from the sum: the tolerance, and rounding, which is less than 1e-5 of
    /// the greatest value for the named functions.
    double error_bound() const noexcept { return error_bound_; }
    double total_weight() const noexcept { return total_weight_; }
    /// The greatest that a value's magnitude can be: total_weight * greatest |f|.
    double greatest_value() const noexcept { return greatest_value_; }

    const UnitFrame& frame() const noexcept { return frame_; }
    const TangentialFunction& function() const noexcept { return function_; }
    std::size_t plane_count() const noexcept;

    /// How many clusters and planes a value looked at, for benches.
    struct Work {
        std::uint64_t clusters = 0;
        std::uint64_t planes = 0;
    };
    double value(const glm::dvec3& point, Work& work) const;
    /// What the loops were compiled for, as Highway names it.
    static std::string_view instruction_set();

private:
    friend class DiscountedField;

    double value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                      kernels::FieldWork& work) const;

    UnitFrame frame_;
    TangentialFunction function_;
    double total_weight_ = 0.0;
    double greatest_value_ = 0.0;
    double error_bound_ = 0.0;
    std::unique_ptr<const FieldSums> sums_;
};

}  // namespace rimline
