#pragma once

// The cells that the incremental update walks on (thesis 3.4.3): the octree without the nodes below its
// active-set candidates, with its empty octants added. Its leaves, the tiles, are candidates and empty
// octants; they fill the root without gaps.
//
// The text walks from node to node along their neighbor links. Where an octant is empty, its link leads to an
// ancestor: the walk then continues in a wrong part of the tree, or stops, and misses the active region
// beyond the octant. Here an empty octant costs one box, and a walk crosses it like any other.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/v_sphere.h"
#include "silhouette/methods/literal/active_set_candidates.h"
#include "silhouette/methods/literal/neighbor_graph.h"
#include "silhouette/methods/literal/point_octree.h"

namespace rimline {

struct SearchCells {
    /// A full octree: eight children or none. The root is cell 0; tiles have no children.
    std::vector<OctreeNode> cells;
    std::vector<NeighborNodes> neighbors;  ///< One a cell; no tile's neighbor is below a tile.
    std::vector<std::uint32_t> node_of;    ///< The octree's node; k_no_node for empty octants.
    std::vector<HoughBox> boxes;           ///< OBVs, widened by `error`.
    std::vector<float> reaches;            ///< Of the boxes.
    /// One a cell: bit i is set if the cell touches the root's face in direction i (NeighborNodes).
    std::vector<std::uint8_t> root_faces;
    std::uint32_t empty_tiles = 0;
};

/// Every OBV is the octant widened by `error` on all sides, so that it contains the exact foot point of each
/// plane whose rounded foot point is in the octant.
SearchCells build_search_cells(const PointOctree& octree, const ActiveSetCandidates& candidates,
                               double error);

}  // namespace rimline
