#pragma once

// How much of a mesh a viewpoint shows, if nothing hides anything. Votes know no areas: all side faces of a pencil vote
// for a viewpoint before its end, and the most votes for a box come from the corner of three planes, which shows one
// face.

#include <glm/vec3.hpp>
#include <stop_token>

#include "silhouette/field/tangential_field.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The area of the faces that are seen from in front, as a share of the greatest one of a hundred viewpoints all
/// around. A face does not count in its plane and behind it, and counts whole at a distance of half the mesh's radius,
/// from where it is seen at 15 to 20 degrees. Both sides count, unless the mesh is closed and consistently oriented. A
/// tangential distance field weighted by area: smooth, and the same for every triangulation.
class FrontArea {
public:
    /// O(faces log faces), on all threads of oneTBB. Throws Error{cancelled}.
    explicit FrontArea(const Mesh& mesh, const std::stop_token& stop = {});

    /// In [0, 1]. `point` is in unit coordinates (unit_planes.h), in the shell of best_views.h. 1 for a mesh without
    /// planes.
    double share(const glm::dvec3& point) const;

private:
    TangentialField field_;
    double greatest_ = 0.0;
};

}  // namespace rimline
