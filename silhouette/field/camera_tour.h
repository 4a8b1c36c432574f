#pragma once

// The nodes of a camera path around a mesh (thesis 4.5.5): the best views, and between two consecutive ones
// a node with an interesting view.
//
//   Intermediate nodes. The midpoint of two views, projected to the middle radius of the shell, climbs to
//   a nearby peak of the field. This is the first field, where every plane still has its votes. The node
//   moves at most a third of the way to either view, so it stays between them. For opposite views it is
//   the best point of the great circle between them, and for views in the same direction the best point
//   of a circle around them.
//
//   Order. A greedy choice: from the first view to the unvisited view whose intermediate node has the
//   most votes, and so on; from the last view back to the first.
//
// The views do not move. CameraPath (camera_path.h) makes a smooth path through the nodes.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

struct TourNode {
    glm::dvec3 place;                   ///< In the mesh's coordinates.
    double votes;                       ///< In the first field.
    std::optional<std::uint32_t> view;  ///< The index of the view. Empty for an intermediate node.
};

/// `views` holds two or more viewpoints in the shell of best_views.h, in the mesh's coordinates. `field`
/// comes from make_view_field. Returns twice as many nodes as views. Views and intermediate nodes
/// alternate, beginning with a view. Consecutive nodes are 1/100 to 103 degrees apart. O(views^2) climbs.
/// Throws Error{cancelled}.
std::vector<TourNode> plan_tour(const TangentialField& field, std::span<const glm::dvec3> views,
                                const LongCall& call = {});

}  // namespace rimline
