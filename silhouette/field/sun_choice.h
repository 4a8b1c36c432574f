#pragma once

// The directional light that shows most of what a viewpoint sees (thesis 4.6).
//
// Of the field of light_function (named_functions.h), over the planes that face the viewpoint alone, the
// peak in the shell of best_views.h: light that grazes surfaces, so that small changes of angle show, and
// leaves none of them in the dark. The direction towards the peak is the sun. There is one: a second light
// would wash out the contrast that the first was chosen for (4.6.2).

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/field/tangential_field.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct ChosenSun {
    glm::dvec3 direction;     ///< From the mesh towards the light, of length 1.
    double votes;             ///< A sum over the faces; no face votes more than 1.
    std::uint32_t faces;      ///< That face the viewpoint.
    bool sees_backs = false;  ///< None did; their backs do, as of a sheet seen from behind.
};

/// `eye` is in the mesh's coordinates, and may lie anywhere. A closed mesh that is wound inside out is
/// taken the other way round (winding.h). Nothing where no face has a side towards the eye: of a mesh
/// without planes, or seen edge-on. Throws Error{cancelled}.
std::optional<ChosenSun> choose_sun(const Mesh& mesh, const glm::dvec3& eye,
                                    const LongCall& call = {});

}  // namespace rimline
