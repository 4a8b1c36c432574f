#include "silhouette/field/best_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "silhouette/field/front_area.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/upright.h"

namespace rimline {

TangentialField make_view_field(const Mesh& mesh, const FieldOptions& options,
                                const TangentialFunction& function, const std::stop_token& stop) {
    return TangentialField(outward_planes(mesh, stop), function, options, stop);
}

namespace {

// Caches ratios. They do not depend on the views chosen before, so no viewpoint is rendered twice.
class DrawnOnce {
public:
    DrawnOnce(const UnitFrame& frame, const VisibleRatios& ratios)
        : frame_(frame), ratios_(ratios) {}

    std::vector<double> operator()(std::span<const glm::dvec3> points) {
        std::vector<glm::dvec3> eyes;
        std::vector<Key> keys;
        for (const glm::dvec3& point : points) {
            const Key key{point.x, point.y, point.z};
            if (!known_.try_emplace(key, 0.0).second) continue;
            keys.push_back(key);
            eyes.push_back(frame_.to_model(point));
        }
        if (!eyes.empty()) {
            const std::vector<double> ratios = ratios_(eyes);
            RIMLINE_CHECK(ratios.size() == eyes.size());
            for (std::size_t i = 0; i < keys.size(); ++i) known_[keys[i]] = ratios[i];
        }
        std::vector<double> all;
        all.reserve(points.size());
        for (const glm::dvec3& point : points) all.push_back(known_[{point.x, point.y, point.z}]);
        return all;
    }
    std::uint64_t count() const { return known_.size(); }

private:
    using Key = std::array<double, 3>;
    const UnitFrame& frame_;
    const VisibleRatios& ratios_;
    std::map<Key, double> known_;
};

// Sorts all but the first by their scores with all votes.
void rank(const TangentialField& field, std::vector<PointOfInterest>& points) {
    std::vector<std::pair<double, PointOfInterest>> alone;
    for (const PointOfInterest& point : points)
        alone.emplace_back(field.value(point.point) * point.weight, point);
    std::ranges::stable_sort(alone.begin() + 1, alone.end(), std::greater(),
                             [](const auto& scored) { return scored.first; });
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = alone[i].second;
}

}  // namespace

double height_preference(const glm::dvec3& direction, const glm::dvec3& up) {
    constexpr double k_least = 0.5;
    constexpr double k_least_from_rad = std::numbers::pi / 3.0;
    const double height = glm::dot(glm::normalize(direction), glm::normalize(up));
    const double below_rad = -std::asin(std::clamp(height, -1.0, 0.0));
    return 1.0 - (1.0 - k_least) * std::min(below_rad / k_least_from_rad, 1.0);
}

double view_preference(const glm::dvec3& direction, const glm::dvec3& up) {
    constexpr double k_least_behind = 0.8;
    const double likeness = std::min(three_quarter_likeness(glm::normalize(direction), up), 1.0);
    return height_preference(direction, up) *
           (1.0 - (1.0 - k_least_behind) * 0.5 * (1.0 - likeness));
}

double area_preference(double front_share, std::size_t chosen) {
    constexpr double k_enough = 0.8;
    const double share = std::min(front_share / k_enough, 1.0);
    return chosen > 0 ? share * share : (share * share) * (share * share);
}

std::optional<int> symmetry_axis(const Mesh& mesh) {
    const UprightEvidence evidence = measure_upright(mesh);
    for (int axis = 0; axis < 3; ++axis)
        if (is_symmetric_across_alone(evidence, std::size_t(axis))) return axis;
    return std::nullopt;
}

BestViews find_best_views(const TangentialField& field, const BestViewsOptions& options,
                          const LongCall& call) {
    RIMLINE_CHECK(!options.up || glm::length(*options.up) > 0.0);
    const UnitFrame& frame = field.frame();
    const glm::dvec3 c = glm::abs(frame.center);
    if (std::max({c.x, c.y, c.z}) + k_view_shell.outer_radius * frame.radius > k_max_coordinate)
        throw Error(ErrorCode::too_large,
                    "coordinates are too large for viewpoints around the model: scale it down");
    DrawnOnce drawn(frame, options.visible_ratios);
    InterestOptions interest;
    interest.count = options.count;
    interest.weighs_all = options.draws_all;
    interest.steady = options.for_people;
    std::optional<FrontArea> front;
    if (options.mesh) front.emplace(*options.mesh, call.stop);
    const auto preference = [&](const glm::dvec3& point, std::size_t chosen) {
        return (options.up ? view_preference(point, *options.up) : 1.0) *
               (front ? area_preference(front->share(point), chosen) : 1.0);
    };
    const bool prefers = options.up || front;
    // Where a view is drawn, its preference is known before.
    if (options.visible_ratios && prefers)
        interest.bound = [&](std::span<const glm::dvec3> points, std::size_t chosen) {
            std::vector<double> bounds;
            for (const glm::dvec3& point : points) bounds.push_back(preference(point, chosen));
            return bounds;
        };
    if (options.visible_ratios || prefers || options.for_people)
        interest.weigh = [&](std::span<const glm::dvec3> points, std::size_t chosen) {
            std::vector<double> weights(points.size(), 1.0);
            if (options.visible_ratios) weights = drawn(points);
            for (std::size_t i = 0; i < points.size(); ++i)
                weights[i] *= preference(points[i], chosen);
            return weights;
        };
    interest.mirror_axis = options.mirror_axis;
    interest.weighed_stride = options.visible_ratios ? options.stride : 1;
    // Candidates that are rendered are refined to weighed_tolerance only.
    if (options.visible_ratios) interest.tolerance = 0.5 * interest.weighed_tolerance;
    PointsOfInterest found = find_points_of_interest(field, k_view_shell, interest, call);
    if (options.for_people && found.points.size() > 2) rank(field, found.points);

    BestViews result{.views = {},
                     .renders = drawn.count(),
                     .candidates = options.visible_ratios ? found.candidates : 0,
                     .evaluations = found.evaluations};
    for (const PointOfInterest& point : found.points)
        result.views.push_back({.eye = frame.to_model(point.point),
                                .votes = point.votes,
                                .visible_ratio = options.visible_ratios
                                                     ? drawn(std::span(&point.point, 1)).front()
                                                     : 1.0,
                                .preference = preference(point.point, result.views.size())});
    return result;
}

}  // namespace rimline
