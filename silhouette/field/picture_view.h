#pragma once

// The direction from which one picture shows a mesh best, found fast enough not to be felt.
//
// Candidates are 72 directions, a little above the ground: 24 around the up axis at 8, 20 and 32 degrees, or for a flat
// mesh at 21, 33 and 45. The votes of best_views.h choose eight of them that are at least 25 degrees apart. Of
// these the visible share of the silhouette is measured, on the CPU, so that the result does not depend on a
// device. The score is votes times share, as there, times
//
//   the square root of the area that is covered: a plate is not seen along its plane;
//   less where much more of the surface is seen at a low angle than from another candidate: votes are highest near
//     planes, but the faces of a box are shown only away from them. exp(-(s / 0.15 - 1)^2), where s > 0.15 is how much
//     more. A face counts whole along its plane, and not at 30 degrees to it. Organic shapes differ by 0.1 to 0.2;
//   a preference: 1 for the three-quarter views of the side that the mesh faces (front_side.h), to the right or left,
//     and for what is 90 degrees or more away from both less: down to 0.5, the more certain that side is. Votes
//     hardly know a face from the back of a head.
//
// Among the directions whose score is within 5% of the best one, the nearest to a three-quarter view is chosen, if that
// side is known.
//
// The preferences, the elevations and the area were chosen by looking at pictures of 35 meshes: those of this project
// (docs/contributing.md) and some of CGAL's. They were judged on no others. The limit of low angles was chosen on this
// project's and a box, a brick with studs and a table, and judged on eleven other small models.
//
//   Visible share. The faces are drawn into a buffer of 160 x 160 depths, orthographic. A silhouette edge or border is
//     sampled at each pixel. A sample is visible if it is not behind all of the nine depths around it.

#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// What a direction shows of a mesh.
struct Shown {
    double visible_share;  ///< Of the silhouette and the borders, 0 to 1; 1 if there is none.
    double area;           ///< Of the mesh's picture, as a share of that of the sphere around it.
};

/// Orthographic, the whole mesh, for each direction (towards the viewer, not zero). O(faces + pixels) for each, on all
/// threads of oneTBB. Throws Error{cancelled}.
std::vector<Shown> measure_shown(const Mesh& mesh, std::span<const glm::dvec3> directions,
                                 const std::stop_token& stop = {});

/// Of length 1, from the mesh towards the viewer. three_quarter_direction(up) for a mesh without planes. Does
/// not depend on the number of threads. 0.1 s for 100,000 faces. Throws Error{cancelled}.
glm::dvec3 choose_picture_direction(const Mesh& mesh, const glm::dvec3& up,
                                    const LongCall& call = {});

}  // namespace rimline
