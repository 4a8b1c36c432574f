#pragma once

// Drawings of a mesh from many cameras, each against the oracle (line_oracle.h).

#include <cstdint>

#include "silhouette/lines/line_oracle.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tests {

/// Where the cameras of a check stand.
enum class Cameras {
    around,  ///< At three radii.
    axes,    ///< The same, along the six axes in turn: many things coincide in the picture.
    inside,  ///< Within the mesh's sphere.
};

/// Draws `views` perspective and as many orthographic views, and checks that no sample is wrong, that no line is
/// missing, that no cycle of lines contradicts itself, and that something was decided. `pixels` is the number of
/// samples along the picture.
void check_views(const Mesh& mesh, Cameras cameras, std::uint32_t views, std::uint64_t seed,
                 double pixels = 1000.0);

/// A camera towards the mesh's center.
LineView view_of(const Mesh& mesh, const glm::dvec3& direction, bool is_orthographic,
                 double radii = 3.0);

}  // namespace rimline::tests
