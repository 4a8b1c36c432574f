#pragma once

// The umbrellas of PointSurfaceOptions::Method::robust: stars (star_choice.h), then borders and creases
// (border_tracing.h). docs/results/points.md explains the steps.

#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

UmbrellaSet find_robust_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call);

}  // namespace rimline
