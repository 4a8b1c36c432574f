#pragma once

// The neighbor graph (thesis 3.3.1): for each node and each of the six directions, the node where a walk
// continues.
//
// With C the center of a node's octant and e its half-width along u, the neighbor point is C + 2eu. The
// neighbor is the deepest node, no deeper than the node itself, whose octant contains that point: the
// octant of the same size if the tree has it, else a leaf that contains the place, or an ancestor of the
// missing octant, which can be an ancestor of the node itself. The relation is not symmetric (Figure 3.5).
//
// No neighbor point is computed. Within a parent, the neighbor is a sibling. Across the parent's face it is
// the mirrored child of the parent's neighbor, if that is as deep as the parent and has this child.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/methods/literal/point_octree.h"

namespace rimline {

/// One a direction: -x, +x, -y, +y, -z, +z. k_no_node across a face of the root.
using NeighborNodes = std::array<std::uint32_t, 6>;

/// `nodes` are those of a PointOctree, parents first. O(nodes).
std::vector<NeighborNodes> build_neighbor_graph(std::span<const OctreeNode> nodes);

}  // namespace rimline
