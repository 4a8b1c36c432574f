#include "silhouette/field/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/error.h"
#include "silhouette/mesh/angle_between.h"

namespace rimline {

namespace {

// Steps per leg for measuring its length. Within a step the curve's parameter is treated as
// proportional to length. The speed error is below 1% on legs of 170 degrees, and smaller on shorter
// legs.
constexpr std::size_t k_steps = 2048;

// The unit tangent at `from`, along the sphere towards `to`.
glm::dvec3 tangent_towards(const glm::dvec3& from, const glm::dvec3& to) {
    return glm::normalize(to - glm::dot(from, to) * from);
}

// Bisects the directions of arrival and departure. If the path reverses its direction, there is no
// bisector, and the tangent points sideways.
glm::dvec3 tangent_at(const glm::dvec3& node, const glm::dvec3& before, const glm::dvec3& after) {
    const glm::dvec3 back = tangent_towards(node, before);
    const glm::dvec3 ahead = tangent_towards(node, after);
    const glm::dvec3 sum = ahead - back;
    const double length = glm::length(sum);
    return length > 1e-6 ? sum / length : glm::cross(node, ahead);
}

double handle_length(double angle_rad) {
    return std::min(4.0 / 3.0 * std::tan(0.25 * angle_rad), 0.9 * std::cos(0.5 * angle_rad));
}

}  // namespace

CameraPath::CameraPath(const glm::dvec3& center, std::span<const glm::dvec3> nodes)
    : center_(center), nodes_(nodes.begin(), nodes.end()) {
    RIMLINE_CHECK(nodes.size() >= 3);
    const std::size_t count = nodes.size();
    std::vector<glm::dvec3> directions;
    std::vector<double> distances;
    for (const glm::dvec3& node : nodes) {
        const double distance = glm::length(node - center);
        RIMLINE_CHECK(distance > 0.0 && std::isfinite(distance));
        distances.push_back(distance);
        directions.push_back((node - center) / distance);
    }
    std::vector<glm::dvec3> tangents;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const double turn_deg = glm::degrees(angle_between(directions[i], directions[next]));
        RIMLINE_CHECK(turn_deg >= k_min_turn_deg && turn_deg <= k_max_turn_deg);
        tangents.push_back(
            tangent_at(directions[i], directions[(i + count - 1) % count], directions[next]));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const double h = handle_length(angle_between(directions[i], directions[next]));
        legs_.push_back({.control = {directions[i], directions[i] + h * tangents[i],
                                     directions[next] - h * tangents[next], directions[next]},
                         .from_distance = distances[i],
                         .to_distance = distances[next]});
    }
    lengths_.reserve(count * k_steps + 1);
    lengths_.push_back(0.0);
    for (const Leg& leg : legs_) {
        glm::dvec3 last = offset(leg, 0.0);
        for (std::size_t step = 1; step <= k_steps; ++step) {
            const glm::dvec3 here = offset(leg, double(step) / double(k_steps));
            lengths_.push_back(lengths_.back() + glm::distance(last, here));
            last = here;
        }
    }
}

glm::dvec3 CameraPath::offset(const Leg& leg, double t) const noexcept {
    const double s = 1.0 - t;
    const glm::dvec3 bezier = s * s * s * leg.control[0] + 3.0 * s * s * t * leg.control[1] +
                              3.0 * s * t * t * leg.control[2] + t * t * t * leg.control[3];
    const double eased = t * t * (3.0 - 2.0 * t);
    const double distance = leg.from_distance + eased * (leg.to_distance - leg.from_distance);
    return distance * glm::normalize(bezier);
}

glm::dvec3 CameraPath::position(double share) const noexcept {
    RIMLINE_CHECK(std::isfinite(share));
    const double wanted = (share - std::floor(share)) * length();
    const auto after = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, wanted);
    const std::size_t step = static_cast<std::size_t>(after - lengths_.begin()) - 1;
    const double span = lengths_[step + 1] - lengths_[step];
    const double within = span > 0.0 ? (wanted - lengths_[step]) / span : 0.0;
    const double t = (double(step % k_steps) + within) / double(k_steps);
    return center_ + offset(legs_[step / k_steps], t);
}

double CameraPath::share_of_node(std::size_t node) const noexcept {
    RIMLINE_CHECK(node < nodes_.size());
    return lengths_[node * k_steps] / length();
}

}  // namespace rimline
