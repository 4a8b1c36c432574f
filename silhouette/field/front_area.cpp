#include "silhouette/field/front_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "silhouette/field/named_functions.h"

namespace rimline {

namespace {

constexpr double k_whole_from = 0.5;  // In radii.
constexpr double k_radius = 1.87;     // In the middle of the shell.
constexpr int k_directions = 100;

TangentialField make_field(const Mesh& mesh, const std::stop_token& stop) {
    const bool has_fronts = mesh.is_closed() && mesh.is_oriented();
    return {outward_planes(mesh, stop),
            has_fronts ? far_in_front(0.0, k_whole_from) : far_from_plane(0.0, k_whole_from),
            {.tolerance = 5e-3, .weight = FieldOptions::Weight::area},
            stop};
}

}  // namespace

FrontArea::FrontArea(const Mesh& mesh, const std::stop_token& stop)
    : field_(make_field(mesh, stop)) {
    // On a spiral that turns by the golden angle.
    constexpr double k_turn_rad = std::numbers::pi * (3.0 - 2.23606797749979);
    for (int i = 0; i < k_directions; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / k_directions;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(r * std::cos(k_turn_rad * i), r * std::sin(k_turn_rad * i), z);
        greatest_ = std::max(greatest_, field_.value(k_radius * direction));
    }
}

double FrontArea::share(const glm::dvec3& point) const {
    return greatest_ > 0.0 ? std::clamp(field_.value(point) / greatest_, 0.0, 1.0) : 1.0;
}

}  // namespace rimline
