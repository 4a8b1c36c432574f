#pragma once

// The second pass of the thesis for one point (5.2.4): umbrellas about the normals of trustworthy neighbors,
// which are those with one umbrella without boundary, nearest first.
//
//   rejected   A neighbor that one umbrella admits is in no other, unless it lies on the boundary of the
//              first. A neighbor on two boundaries is in no third. The normals of rejected neighbors are not
//              used.
//   whole      A new umbrella without boundary is dropped if it has the fewest points. Else it replaces all
//              others.
//   ended      The pass ends when every boundary edge is on two boundaries, when no trustworthy neighbor
//              remains, or at four umbrellas.

#include <glm/vec3.hpp>
#include <span>

#include "silhouette/points/neighborhood.h"
#include "silhouette/points/point_fans.h"

namespace rimline {

/// `first` has the umbrella of the first pass, or none. `normals` are those of the k nearest by place, zero
/// for a neighbor that is not trustworthy. `radius` is that of the point's Gabriel triangle.
PointFans supplemented(const Neighborhood& around, const PointFans& first,
                       std::span<const glm::dvec3> normals, double radius,
                       const PointSurfaceOptions& options);

}  // namespace rimline
