#pragma once

// The tangential distance field of a mesh (thesis 4.1): at a point p, the sum of the votes of its planes,
//
//     D(p) = sum_i w_i f(n_i·p - d_i)                                                            (4.1)
//
// where f is a tangential distance function and w_i is 1 or the area of the plane's face (6.4.2). Points
// are in unit coordinates (unit_planes.h).
//
// Similar planes are summed as clusters (plane_clusters.h) if the error stays within the tolerance. The
// error bound holds at every point (field_kernels.h). Actual errors are smaller, because bounds add up but
// errors cancel: on igea they are a thirtieth of the tolerance. docs/results/field.md has the measurements.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
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
    /// Maximum error of a value as a share of max_value(), plus float rounding (see error_bound). 0:
    /// all planes are summed, in float.
    double tolerance = 1e-3;
    enum class Weight : std::uint8_t { count, area } weight = Weight::count;
};

/// Immutable: any number of threads may use one object. Holds no reference to the planes.
class TangentialField {
public:
    /// The function has at most 32 knots (RIMLINE_CHECK). O(planes log planes) on all threads.
    /// Throws Error{cancelled} if `stop` is requested.
    TangentialField(const UnitPlanes& planes, const TangentialFunction& function,
                    const FieldOptions& options = {}, const std::stop_token& stop = {});
    ~TangentialField();
    TangentialField(TangentialField&&) noexcept;
    TangentialField& operator=(TangentialField&&) noexcept;

    /// Points must be finite (RIMLINE_CHECK). Farther than 4 from the center, all planes are summed in
    /// double.
    double value(const glm::dvec3& point) const;
    /// One value per point, on all threads of oneTBB. The values equal those of value() and do not depend
    /// on the number of threads. (Sums differ by rounding between instruction sets.) Throws
    /// Error{cancelled} if `call` is stopped.
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}) const;
    /// The gradient of the exact sum, in double. O(planes).
    glm::dvec3 gradient(const glm::dvec3& point) const;

    /// Upper bound of the error of a value: the tolerance plus rounding. Rounding is less than 1e-5 of the
    /// maximum value for the named functions.
    double error_bound() const noexcept { return error_bound_; }
    double total_weight() const noexcept { return total_weight_; }
    /// The maximum magnitude of a value: total_weight times the maximum of |f|.
    double max_value() const noexcept { return max_value_; }

    const UnitFrame& frame() const noexcept { return frame_; }
    const TangentialFunction& function() const noexcept { return function_; }
    std::size_t plane_count() const noexcept;

    /// The number of clusters and planes that a value visits, for benchmarks.
    struct Work {
        std::uint64_t clusters = 0;
        std::uint64_t planes = 0;
    };
    double value(const glm::dvec3& point, Work& work) const;
    /// The instruction set in use, as named by Highway.
    static std::string_view instruction_set();

private:
    friend class DiscountedField;

    double value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                      kernels::FieldWork& work, double tolerances = 1.0) const;

    UnitFrame frame_;
    TangentialFunction function_;
    double total_weight_ = 0.0;
    double max_value_ = 0.0;
    double error_bound_ = 0.0;
    std::unique_ptr<const FieldSums> sums_;
};

}  // namespace rimline
