#pragma once

// Octrees for tests, and the region of each node, computed from the root down.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/methods/literal/point_octree.h"

namespace rimline::tests {

/// Points on a lattice of 1024 steps between the corners 0 and 1, which are among them: clusters, single
/// points, and large empty regions. All octants of their octree are exact.
std::vector<glm::dvec3> clustered_points(std::uint32_t count, std::uint64_t seed);

/// One a node.
std::vector<Octant> octants_of(std::span<const OctreeNode> nodes, const Octant& root);

inline bool holds(const Octant& octant, const glm::dvec3& point) {
    for (int axis = 0; axis < 3; ++axis)
        if (point[axis] < octant.low[axis] || point[axis] > octant.high[axis]) return false;
    return true;
}

}  // namespace rimline::tests
