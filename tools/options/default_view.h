#pragma once

// The direction from which every subcommand shows a model if no camera is given.

#include <glm/vec3.hpp>
#include <string>

#include "silhouette/mesh/ground_axes.h"

namespace rimline::tools {

/// The model of `render` if none is given: the built-in scene.
constexpr const char* k_default_model = "shape:scene";

/// From the model towards the viewer. The built-in scene has a direction of its own.
inline glm::dvec3 default_view_of(const std::string& model, const glm::dvec3& up) {
    return model == k_default_model ? glm::dvec3(0.22, 0.45, 1.0) : three_quarter_direction(up);
}

}  // namespace rimline::tools
