#include "silhouette/field/tangential_field.h"

#include <cmath>

#include "silhouette/field/many_values.h"

namespace rimline {

TangentialField::TangentialField(const UnitPlanes& planes, const TangentialFunction& function,
                                 const FieldOptions& options)
    : frame_(planes.frame()), function_(function) {
    RIMLINE_CHECK(options.tolerance >= 0.0);
    planes_.reserve(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double weight = options.weight == FieldOptions::Weight::area ? planes.area(i) : 1.0;
        planes_.push_back({planes.normal(i), planes.offset(i), weight});
        total_weight_ += weight;
    }
    greatest_value_ = total_weight_ * function_.greatest_magnitude();
    error_bound_ = greatest_value_ * 0x1p-50;
}

double TangentialField::value(const glm::dvec3& point) const {
    RIMLINE_CHECK(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
    double sum = 0.0;
    for (const WeightedPlane& plane : planes_)
        sum += plane.weight * function_.value(plane.distance(point));
    return sum;
}

void TangentialField::values(std::span<const glm::dvec3> points, std::span<double> out,
                             const LongCall& call) const {
    many_values(points, out, call, [this](const glm::dvec3& point) { return value(point); });
}

glm::dvec3 TangentialField::gradient(const glm::dvec3& point) const {
    RIMLINE_CHECK(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
    glm::dvec3 sum(0.0);
    for (const WeightedPlane& plane : planes_)
        sum += plane.normal * (plane.weight * function_.slope(plane.distance(point)));
    return sum;
}

}  // namespace rimline
