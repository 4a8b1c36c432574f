#include "silhouette/field/camera_tour.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <numbers>

#include "silhouette/field/best_views.h"
#include "silhouette/mesh/angle_between.h"

namespace rimline {

namespace {

constexpr double k_middle_radius = 0.5 * (k_view_shell.inner_radius + k_view_shell.outer_radius);

// Limits for the movement of a node: in unit coordinates, about 7 degrees, and as a share of the distance
// to either view.
constexpr double k_climb = 0.25;
constexpr double k_climb_share = 1.0 / 3.0;

// Views farther apart than the first angle are opposite. Views nearer than the second have the same
// direction.
constexpr double k_opposite_deg = 175.0;
constexpr double k_same_deg = 0.5;
// The circle around views in the same direction.
constexpr double k_circle_deg = 20.0;
constexpr int k_circle_samples = 72;

struct Between {
    glm::dvec3 point;
    double votes;
};

// The point with the most votes on a circle at `angle_rad` around `axis`, at the middle radius of the
// shell.
glm::dvec3 best_on_circle(const TangentialField& field, const glm::dvec3& axis, double angle_rad) {
    const glm::dvec3 seed = std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(seed - glm::dot(seed, axis) * axis);
    const glm::dvec3 second = glm::cross(axis, first);
    std::vector<glm::dvec3> places;
    for (int i = 0; i < k_circle_samples; ++i) {
        const double a = 2.0 * std::numbers::pi * i / k_circle_samples;
        places.push_back(k_middle_radius *
                         (std::cos(angle_rad) * axis +
                          std::sin(angle_rad) * (std::cos(a) * first + std::sin(a) * second)));
    }
    std::vector<double> votes(places.size());
    field.values(places, votes);
    return places[static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) -
                                           votes.begin())];
}

Between node_between(const TangentialField& field, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 from = glm::normalize(a);
    const glm::dvec3 to = glm::normalize(b);
    const double angle_deg = glm::degrees(angle_between(from, to));
    glm::dvec3 start;
    if (angle_deg > k_opposite_deg)
        start = best_on_circle(field, from, 0.5 * std::numbers::pi);
    else if (angle_deg < k_same_deg)
        start = best_on_circle(field, from, glm::radians(k_circle_deg));
    else
        start = k_middle_radius * glm::normalize(a + b);
    const glm::dvec3 direction = glm::normalize(start);
    const double distance =
        k_middle_radius * std::min(angle_between(direction, from), angle_between(direction, to));
    const PointOfInterest peak =
        climb(field, k_view_shell, start, std::min(k_climb, k_climb_share * distance));
    return {peak.point, peak.votes};
}

}  // namespace

std::vector<TourNode> plan_tour(const TangentialField& field, std::span<const glm::dvec3> views,
                                const LongCall& call) {
    RIMLINE_CHECK(views.size() >= 2);
    const UnitFrame& frame = field.frame();
    const auto count = static_cast<std::uint32_t>(views.size());
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& view : views) points.push_back(frame.from_model(view));

    std::map<std::pair<std::uint32_t, std::uint32_t>, Between> known;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] = known.try_emplace(std::minmax(a, b));
        if (is_new) {
            place->second = node_between(field, points[a], points[b]);
            call.checkpoint(double(known.size()) / (0.5 * count * (count - 1.0)));
        }
        return place->second;
    };

    std::vector<std::uint32_t> unvisited;
    for (std::uint32_t v = 1; v < count; ++v) unvisited.push_back(v);
    std::vector<TourNode> nodes;
    std::uint32_t here = 0;
    const auto add_view = [&] { nodes.push_back({views[here], field.value(points[here]), here}); };
    const auto add_between = [&](const Between& node) {
        nodes.push_back({frame.to_model(node.point), node.votes, std::nullopt});
    };
    add_view();
    while (!unvisited.empty()) {
        auto best = unvisited.begin();
        for (auto next = unvisited.begin(); next != unvisited.end(); ++next)
            if (between(here, *next).votes > between(here, *best).votes) best = next;
        add_between(between(here, *best));
        here = *best;
        unvisited.erase(best);
        add_view();
    }
    add_between(between(here, 0));
    return nodes;
}

}  // namespace rimline
