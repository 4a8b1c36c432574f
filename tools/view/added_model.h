#pragma once

// Where a model goes that is added to the scene in the window, and how those stay that were there before.

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "tools/begin_call.h"
#include "tools/options/placed_model.h"

namespace rimline::tools {

/// The models of a scene, of which some have no place yet.
struct Arrangement {
    std::vector<PlacedModel> models;
    std::vector<std::string> added = {};  ///< Files and built-in shapes, without a place.
    glm::dvec3 up{0, 1, 0};               ///< Of the scene.
    glm::dvec3 towards_viewer{0, 0, 1};
    /// All positions of `models` in the scene, if something is added. They must live until it is placed.
    std::span<const glm::vec3> positions = {};
    bool has_file_colors = true;  ///< Models that are not painted have the colors of their files.
    /// The first of `models` was not the first of the scene before: those before it have been removed.
    bool has_new_first = false;
};

/// The models of the arrangement, with the added ones to the right of the others for the viewer, along an axis, on
/// the same ground, one beside the other. A model is scaled where it would be more than 4 times larger or smaller than
/// the others together. The first model of a scene is not turned to its up; a new first one says in `up` how it was
/// turned before. Reads each added file, and that of a new first model; throws what load_drawn_model() throws.
std::vector<PlacedModel> place_added(const Arrangement& arrangement, const BeginCall& begin);

/// The arguments of `rimline view` that show the models.
std::vector<std::string> view_arguments(std::span<const PlacedModel> models, const glm::dvec3& up);

}  // namespace rimline::tools
