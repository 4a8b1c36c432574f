#pragma once

// The tangential distance field of a mesh (thesis 4.1): at a point p, the sum of what its planes vote,
//
//     D(p) = sum_i w_i f(n_i·p - d_i)                                                            (4.1)
//
// with f a tangential distance function and w_i 1 or the area of the plane's face (6.4.2). Points are in
// unit coordinates (unit_planes.h).

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/field/tangential_function.h"
#include "silhouette/field/unit_planes.h"

namespace rimline {

struct FieldOptions {
    /// Of every value, as a share of the greatest that a value can be (total_weight * greatest |f|);
    /// 0: all planes are summed.
    double tolerance = 1e-4;
    enum class Weight : std::uint8_t { count, area } weight = Weight::count;
};

/// Immutable: any number of threads may use one. Keeps what it needs of the planes.
class TangentialField {
public:
    TangentialField(const UnitPlanes& planes, const TangentialFunction& function,
                    const FieldOptions& options = {});

    /// Points are finite (RIMLINE_CHECK).
    double value(const glm::dvec3& point) const;
    /// One for each point, on all threads that oneTBB gives; the same whatever their number, and the same
    /// as value's. A cancelled `call` throws Error{cancelled}.
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {}) const;
    /// Of the exact sum, in double. O(planes).
    glm::dvec3 gradient(const glm::dvec3& point) const;

    /// No value differs by more from the sum.
    double error_bound() const noexcept { return error_bound_; }
    double total_weight() const noexcept { return total_weight_; }
    /// The greatest that a value's magnitude can be.
    double greatest_value() const noexcept { return greatest_value_; }

    const UnitFrame& frame() const noexcept { return frame_; }
    const TangentialFunction& function() const noexcept { return function_; }
    std::size_t plane_count() const noexcept { return planes_.size(); }

private:
    friend class DiscountedField;
    struct WeightedPlane {
        glm::dvec3 normal;
        double offset;
        double weight;
        double distance(const glm::dvec3& p) const noexcept {
            return (normal.x * p.x + normal.y * p.y + normal.z * p.z) - offset;
        }
    };

    UnitFrame frame_;
    TangentialFunction function_;
    std::vector<WeightedPlane> planes_;
    double total_weight_ = 0.0;
    double greatest_value_ = 0.0;
    double error_bound_ = 0.0;
};

}  // namespace rimline
