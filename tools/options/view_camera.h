#pragma once

// The camera of a picture from a chosen viewpoint.
//
// Its numbers are those that the options --eye, --target, --up and --fov of `render` give when they are parsed: points
// and directions are rounded to float first, and what follows from them is computed after that. Therefore a camera
// that is printed and given again draws the same picture, byte for byte.

#include <glm/vec3.hpp>

#include "silhouette/lines/fitted_eye.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/rounded_to_float.h"

namespace rimline::tools {

using rimline::rounded_to_float;

struct ViewCamera {
    glm::dvec3 eye, target, up;
    double fov_y_deg;
};

/// In degrees, at least 1.
double field_of_view_deg(const FittedLens& lens);

/// A camera at `eye` that shows the whole mesh in a picture `aspect` times as wide as high. Where the mesh reaches
/// beside or behind the eye, it looks at the mesh's center, with a field of view of 90 degrees. O(vertices).
ViewCamera camera_of_view(const Mesh& mesh, const glm::dvec3& eye, const glm::dvec3& up,
                          double aspect);

}  // namespace rimline::tools
