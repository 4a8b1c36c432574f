#pragma once

// The silhouette of a cloud followed while a viewpoint goes round it: how long updates take.

#include <cstdint>

#include "silhouette/points/umbrella_index.h"
#include "tools/command.h"

namespace rimline::tools {

struct PointTurn {
    std::uint32_t frames = 0;
    double step_deg = 0.0;
    /// Microseconds a frame, to silhouette points and consensus edges.
    double median_us = 0.0, p99_us = 0.0, worst_us = 0.0;
    double changed_points = 0.0;  ///< That join or leave in a frame, in the mean.
    /// Frames whose silhouette was not what finding it afresh gives. Only counted where asked for.
    std::uint32_t differences = 0;
};

/// In the plane perpendicular to `up`, two radii from the center, from the first axis in that plane.
/// Throws Error{cancelled}.
PointTurn turn_around(const UmbrellaIndex& umbrellas, const glm::dvec3& up, std::uint32_t frames,
                      double step_deg, bool verify, const Context& context);

}  // namespace rimline::tools
