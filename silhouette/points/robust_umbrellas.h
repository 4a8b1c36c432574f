#pragma once

// Umbrellas as PointSurfaceOptions::Method::robust finds them.

#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

UmbrellaSet find_robust_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call);

}  // namespace rimline
