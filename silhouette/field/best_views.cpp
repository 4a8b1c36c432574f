#include "silhouette/field/best_views.h"

#include <array>
#include <map>

#include "silhouette/mesh/winding.h"

namespace rimline {

TangentialField make_view_field(const Mesh& mesh, const FieldOptions& options,
                                const TangentialFunction& function) {
    const UnitPlanes planes =
        is_inside_out(mesh) ? UnitPlanes(turned_inside_out(mesh)) : UnitPlanes(mesh);
    return TangentialField(planes, function, options);
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

}  // namespace

BestViews find_best_views(const TangentialField& field, const BestViewsOptions& options,
                          const LongCall& call) {
    const UnitFrame& frame = field.frame();
    DrawnOnce drawn(frame, options.visible_ratios);
    InterestOptions interest;
    interest.count = options.count;
    interest.weighs_all = options.draws_all;
    if (options.visible_ratios)
        interest.weigh = [&](std::span<const glm::dvec3> points) { return drawn(points); };
    interest.weighed_stride = options.stride;
    const PointsOfInterest found = find_points_of_interest(field, k_view_shell, interest, call);

    BestViews result{.views = {},
                     .renders = drawn.count(),
                     .candidates = found.candidates,
                     .evaluations = found.evaluations};
    for (const PointOfInterest& point : found.points)
        result.views.push_back({.eye = frame.to_model(point.point),
                                .votes = point.votes,
                                .visible_ratio = point.weight});
    return result;
}

}  // namespace rimline
