#pragma once

// Times of updating the silhouette of a cloud while the viewpoint moves around it.

#include <cstdint>

#include "silhouette/points/umbrella_index.h"
#include "tools/command.h"

namespace rimline::tools {

struct PointTurn {
    std::uint32_t frames = 0;
    double step_deg = 0.0;
    /// Microseconds per frame, for silhouette points and consensus edges.
    double median_us = 0.0, p99_us = 0.0, worst_us = 0.0;
    double changed_points = 0.0;  ///< Mean number of points per frame that are added or removed.
    /// Number of frames whose silhouette differs from a new extraction. 0 unless `verify`.
    std::uint32_t differences = 0;
};

/// Moves around the cloud in the plane perpendicular to `up`, at two radii from the center, starting at the
/// first axis in that plane. With `verify`, compares every frame with a new extraction. Throws
/// Error{cancelled}.
PointTurn measure_turn(const UmbrellaIndex& umbrellas, const glm::dvec3& up, std::uint32_t frames,
                       double step_deg, bool verify, const Context& context);

}  // namespace rimline::tools
