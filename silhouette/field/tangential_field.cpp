#include "silhouette/field/tangential_field.h"

#include <cmath>

#include "silhouette/field/field_sums.h"
#include "silhouette/field/many_values.h"
#include "silhouette/is_finite.h"

namespace rimline {

namespace {

// For fewer planes, summing all of them is faster.
constexpr std::size_t k_min_clustered = 1024;

}  // namespace

TangentialField::TangentialField(const UnitPlanes& planes, const TangentialFunction& function,
                                 const FieldOptions& options, const std::stop_token& stop)
    : frame_(planes.frame()), function_(function) {
    RIMLINE_CHECK(options.tolerance >= 0.0);
    std::vector<double> weights(planes.size(), 1.0);
    if (options.weight == FieldOptions::Weight::area)
        for (std::size_t i = 0; i < planes.size(); ++i) weights[i] = planes.area(i);
    for (const double weight : weights) total_weight_ += weight;
    max_value_ = total_weight_ * function_.max_magnitude();

    auto sums = std::make_unique<FieldSums>(FieldSums{
        PlaneClusters(planes, weights, stop), kernels::FunctionTable(function_), {}, 0.0});
    sums->planes.reserve(planes.size());
    for (const std::uint32_t i : sums->clusters.order()) {
        if (sums->planes.size() % k_planes_a_checkpoint == 0) LongCall{stop, {}}.checkpoint(0.0);
        sums->planes.push_back({planes.normal(i), planes.offset(i), weights[i]});
    }
    if (planes.size() >= k_min_clustered) sums->budget = options.tolerance * max_value_;
    error_bound_ = sums->budget + sums->function.rounding_share * total_weight_;
    sums_ = std::move(sums);
}

TangentialField::~TangentialField() = default;
TangentialField::TangentialField(TangentialField&&) noexcept = default;
TangentialField& TangentialField::operator=(TangentialField&&) noexcept = default;

std::size_t TangentialField::plane_count() const noexcept { return sums_->planes.size(); }

std::string_view TangentialField::instruction_set() { return kernels::field_instruction_set(); }

double TangentialField::value(const glm::dvec3& point) const {
    Work work;
    return value(point, work);
}

double TangentialField::value(const glm::dvec3& point, Work& work) const {
    kernels::FieldScratch scratch = sums_->make_scratch();
    kernels::FieldWork visited;
    const double result = value_with(scratch, point, visited);
    work.clusters += visited.clusters;
    work.planes += visited.planes;
    return result;
}

void TangentialField::values(std::span<const glm::dvec3> points, std::span<double> out,
                             const LongCall& call) const {
    many_values(points, out, call, [this] {
        return [this, scratch = sums_->make_scratch(), work = kernels::FieldWork()](
                   const glm::dvec3& point) mutable { return value_with(scratch, point, work); };
    });
}

double TangentialField::value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                                   kernels::FieldWork& work, double tolerances) const {
    RIMLINE_CHECK(is_finite(point));
    if (FieldSums::is_near(point)) return sums_->sum(nullptr, point, scratch, work, tolerances);
    double sum = 0.0;
    for (const FieldSums::ExactPlane& plane : sums_->planes)
        sum += plane.weight * function_.value(plane.distance(point));
    work.planes += sums_->planes.size();
    return sum;
}

glm::dvec3 TangentialField::gradient(const glm::dvec3& point) const {
    RIMLINE_CHECK(is_finite(point));
    glm::dvec3 sum(0.0);
    for (const FieldSums::ExactPlane& plane : sums_->planes)
        sum += plane.normal * (plane.weight * function_.slope(plane.distance(point)));
    return sum;
}

}  // namespace rimline
