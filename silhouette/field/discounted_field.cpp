#include "silhouette/field/discounted_field.h"

#include <algorithm>
#include <cmath>

#include "silhouette/field/many_values.h"

namespace rimline {

DiscountedField::DiscountedField(const TangentialField& field) : field_(&field) {}

void DiscountedField::discount(const glm::dvec3& chosen) {
    RIMLINE_CHECK(std::isfinite(chosen.x) && std::isfinite(chosen.y) && std::isfinite(chosen.z));
    const bool is_first = previous_.empty();
    previous_.resize(field_->planes_.size());
    for (std::size_t i = 0; i < previous_.size(); ++i) {
        const double vote = field_->function_.value(field_->planes_[i].distance(chosen));
        previous_[i] = is_first ? vote : std::max(previous_[i], vote);
    }
}

double DiscountedField::value(const glm::dvec3& point) const {
    if (previous_.empty()) return field_->value(point);
    RIMLINE_CHECK(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
    double sum = 0.0;
    for (std::size_t i = 0; i < previous_.size(); ++i) {
        const auto& plane = field_->planes_[i];
        sum += plane.weight *
               std::max(0.0, field_->function_.value(plane.distance(point)) - previous_[i]);
    }
    return sum;
}

void DiscountedField::values(std::span<const glm::dvec3> points, std::span<double> out,
                             const LongCall& call) const {
    many_values(points, out, call, [this](const glm::dvec3& point) { return value(point); });
}

double DiscountedField::error_bound() const noexcept { return field_->error_bound(); }

}  // namespace rimline
