#pragma once

// The experiments of thesis 4.5.4 and 4.6.3 on a model, as pictures: four views in a row each.
//
//   votes      planes' votes alone (Figure 4.12, right)          ratio    with visible ratios (left)
//   10k, 20k   of the model simplified to so many faces (4.13)   bent     of the model in another pose (4.14)
//   plateau_2  with the votes of faces in front reaching their greatest at 2α, in place of α
//   light      the views `ratio` lit from over the viewer's shoulder, and below, by the chosen sun (4.19)

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// Writes NAME_EXPERIMENT.png for each, NAME the model's own without folder and ending, into a folder that
/// is made where it is missing; all of a model when all are drawn.
void draw_view_experiments(const std::string& model, const Mesh& mesh, const Device& device,
                           const std::optional<glm::vec3>& up, const std::filesystem::path& folder,
                           const Context& context);

}  // namespace rimline::tools
