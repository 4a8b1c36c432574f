#pragma once

// The umbrellas of PointSurfaceOptions::Method::thesis: the passes of 5.2. Each is a loop over points that
// reads the results of earlier passes, and never those of the current pass at another point.
//
//   1  Where the Gabriel triangle is trusted: an umbrella about it (thesis_fan.h).
//   2  Where that umbrella has a boundary, or the triangle was not trusted: umbrellas about the normals of
//      neighbors (thesis_supplements.h).
//   3  Boundaries are made consistent with those of neighbors (thesis_consistency.h).
//
// All use the k nearest neighbors alone, as the thesis does. Where its text can be read in two ways,
// docs/results/points.md has the figures of both.

#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

UmbrellaSet find_thesis_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call);

}  // namespace rimline
