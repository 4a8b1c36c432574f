#pragma once

// The directional light that shows the most detail of the surfaces visible from a viewpoint (thesis 4.6).
//
// The field of light_function (named_functions.h) sums the planes that face the viewpoint. Its peak in the
// shell of best_views.h gives the direction towards the light. Such light falls on surfaces at small
// angles, so that small changes of angle are visible, and leaves no surface dark. There is one light only,
// because a second one would reduce the contrast of the first (4.6.2).

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/field/tangential_field.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct ChosenSun {
    glm::dvec3 direction;     ///< Unit vector from the mesh towards the light.
    double votes;             ///< A sum over the faces. Each face votes at most 1.
    std::uint32_t faces;      ///< Number of faces that face the viewpoint.
    bool sees_backs = false;  ///< Backs are used, because no front faces the viewpoint.
};

/// `eye` is in the mesh's coordinates, each at most 2^60 in size. A closed inside-out mesh is reversed first
/// (winding.h). Returns nothing if no face shows either side to the eye: for a mesh without planes or seen
/// edge-on. Throws Error{cancelled}.
std::optional<ChosenSun> choose_sun(const Mesh& mesh, const glm::dvec3& eye,
                                    const LongCall& call = {});

}  // namespace rimline
