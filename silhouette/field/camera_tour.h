#pragma once

// The nodes of a camera path around a mesh (thesis 4.5.5): the best views, and between each two that follow
// each other a node that leads by way of interesting views.
//
//   Between two views. The middle of the line between them, moved out to the middle of the shell, climbs
//   to the peak of the field nearby: the first field, in which every plane still has its vote. It climbs
//   no farther than a third of the way to either view, so that it stays between them. Views opposite each
//   other have no middle: then the best of the great circle between them is taken, and of views in one
//   direction the best of a circle around them.
//
//   The order. From the first view on to the one whose node in between has the most votes, among those
//   not yet passed (greedy); from the last one back to the first.
//
// Views stay where they are. CameraPath (camera_path.h) makes a smooth path of the nodes.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"

namespace rimline {

struct TourNode {
    glm::dvec3 place;                   ///< In the mesh's coordinates.
    double votes;                       ///< Of the first field.
    std::optional<std::uint32_t> view;  ///< Its number among the views, for those.
};

/// Two views or more, in the shell of best_views.h, in the mesh's coordinates; `field` is that of
/// make_view_field. Twice as many nodes as views, views first and then every other; consecutive ones are
/// between 1/100 and 103 degrees apart. O(views^2) climbs. Throws Error{cancelled}.
std::vector<TourNode> plan_tour(const TangentialField& field, std::span<const glm::dvec3> views,
                                const LongCall& call = {});

}  // namespace rimline
