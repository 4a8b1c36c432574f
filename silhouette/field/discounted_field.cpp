#include "silhouette/field/discounted_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "silhouette/field/field_sums.h"
#include "silhouette/field/many_values.h"
#include "silhouette/is_finite.h"

namespace rimline {

namespace {

using kernels::DiscountNode;

constexpr DiscountNode nothing() {
    DiscountNode node{};
    node.min_vote.fill(std::numeric_limits<float>::infinity());
    node.max_vote.fill(-std::numeric_limits<float>::infinity());
    return node;
}

}  // namespace

DiscountedField::DiscountedField(const TangentialField& field) : field_(&field) {}
DiscountedField::~DiscountedField() = default;
DiscountedField::DiscountedField(DiscountedField&&) noexcept = default;
DiscountedField& DiscountedField::operator=(DiscountedField&&) noexcept = default;

void DiscountedField::discount(const glm::dvec3& chosen) {
    RIMLINE_CHECK(is_finite(chosen));
    const FieldSums& sums = *field_->sums_;
    previous_.resize(sums.planes.size(), -std::numeric_limits<double>::infinity());
    if (!discount_) discount_ = std::make_unique<kernels::Discount>();
    discount_->previous.assign(sums.clusters.planes().d.size(), 0.0f);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, previous_.size(), 4096),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                          for (std::size_t i = part.begin(); i < part.end(); ++i) {
                              const double distance = sums.planes[i].distance(chosen);
                              previous_[i] =
                                  std::max(previous_[i], field_->function_.value(distance));
                              discount_->previous[i] = static_cast<float>(previous_[i]);
                          }
                      });

    // Clusters of leaves, then clusters of clusters.
    const auto levels = sums.clusters.levels();
    discount_->levels.assign(levels.size(), {});
    std::vector<double> cluster_sums;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        std::vector<DiscountNode>& nodes = discount_->levels[level];
        nodes.assign(levels[level].size(), nothing());
        const std::size_t span = level == 0 ? k_leaf_planes : k_cluster_fan;
        const std::size_t parts = level == 0 ? previous_.size() : cluster_sums.size();
        std::vector<double> node_sums((parts + span - 1) / span, 0.0);
        for (std::size_t i = 0; i < parts; ++i) {
            const std::size_t c = i / span;
            DiscountNode& node = nodes[c / k_cluster_fan];
            const std::size_t lane = c % k_cluster_fan;
            float min_vote, max_vote;
            if (level == 0) {
                min_vote = max_vote = discount_->previous[i];
                node_sums[c] += sums.planes[i].weight * previous_[i];
            } else {
                const DiscountNode& below = discount_->levels[level - 1][i / k_cluster_fan];
                min_vote = below.min_vote[i % k_cluster_fan];
                max_vote = below.max_vote[i % k_cluster_fan];
                node_sums[c] += cluster_sums[i];
            }
            node.min_vote[lane] = std::min(node.min_vote[lane], min_vote);
            node.max_vote[lane] = std::max(node.max_vote[lane], max_vote);
        }
        for (std::size_t c = 0; c < node_sums.size(); ++c)
            nodes[c / k_cluster_fan].sum[c % k_cluster_fan] = static_cast<float>(node_sums[c]);
        cluster_sums = std::move(node_sums);
    }
}

double DiscountedField::value(const glm::dvec3& point) const {
    TangentialField::Work work;
    return value(point, work);
}

double DiscountedField::value(const glm::dvec3& point, TangentialField::Work& work) const {
    kernels::FieldScratch scratch = field_->sums_->make_scratch();
    kernels::FieldWork visited;
    const double result = value_with(scratch, point, visited);
    work.clusters += visited.clusters;
    work.planes += visited.planes;
    return result;
}

void DiscountedField::values(std::span<const glm::dvec3> points, std::span<double> out,
                             const LongCall& call, double tolerances) const {
    RIMLINE_CHECK(tolerances >= 1.0);
    many_values(points, out, call, [&] {
        return [this, tolerances, scratch = field_->sums_->make_scratch(),
                work = kernels::FieldWork()](const glm::dvec3& point) mutable {
            return value_with(scratch, point, work, tolerances);
        };
    });
}

double DiscountedField::value_with(kernels::FieldScratch& scratch, const glm::dvec3& point,
                                   kernels::FieldWork& work, double tolerances) const {
    if (!discount_) return field_->value_with(scratch, point, work, tolerances);
    RIMLINE_CHECK(is_finite(point));
    const FieldSums& sums = *field_->sums_;
    if (FieldSums::is_near(point))
        return sums.sum(discount_.get(), point, scratch, work, tolerances);
    double sum = 0.0;
    for (std::size_t i = 0; i < previous_.size(); ++i) {
        const auto& plane = sums.planes[i];
        sum += plane.weight *
               std::max(0.0, field_->function_.value(plane.distance(point)) - previous_[i]);
    }
    work.planes += previous_.size();
    return sum;
}

double DiscountedField::error_bound() const noexcept { return field_->error_bound(); }

}  // namespace rimline
