#include "silhouette/field/front_area.h"

#include <algorithm>
#include <cstdint>

#include "silhouette/field/named_functions.h"
#include "silhouette/hough/spread_viewpoints.h"

namespace rimline {

namespace {

constexpr double k_whole_from = 0.5;  // In radii.
constexpr double k_radius = 1.87;     // In the middle of the shell.
constexpr std::uint32_t k_directions = 100;

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
    for (std::uint32_t i = 0; i < k_directions; ++i)
        greatest_ = std::max(greatest_, field_.value(k_radius * spread_direction(i, k_directions)));
}

double FrontArea::share(const glm::dvec3& point) const {
    return greatest_ > 0.0 ? std::clamp(field_.value(point) / greatest_, 0.0, 1.0) : 1.0;
}

}  // namespace rimline
