#pragma once

// The experiments of thesis 4.5.4 and 4.6.3 on a model, as pictures: four views in a row each.
//
//   votes      planes' votes alone (Figure 4.12, right)          ratio    with visible ratios (left) 10k,
//   20k   of the model simplified to so many faces (4.13)   bent     of the model in another pose (4.14)
//   plateau_2  with votes of front faces that have their maximum at 2α, in place of α light      the views
//   `ratio` with a light over the viewer's shoulder and, below, with the chosen sun (4.19)

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// Writes NAME_EXPERIMENT.png for each; NAME is the model's without folder and ending. Makes the folder
/// where it is missing. Writes the pictures of a model after all of them are drawn.
void draw_view_experiments(const std::string& model, const Mesh& mesh, const Device& device,
                           const std::optional<glm::vec3>& up, const std::filesystem::path& folder,
                           const Context& context);

}  // namespace rimline::tools
