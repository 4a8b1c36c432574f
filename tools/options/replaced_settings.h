#pragma once

// What options in a command line leave of the settings of a scene file.

#include <vector>

#include "tools/cli_classes.h"
#include "tools/options/scene_file.h"

namespace rimline::tools {

/// Call it before use_settings(). Leaves out the settings that belong to another one which the user has replaced: a
/// palette of the style, colors that the style mask does not have, steps of the outline, a frozen silhouette and what
/// it excludes, lamps where the user has chosen three-point lighting.
void drop_replaced(const CLI::App& app, std::vector<SceneFile::Setting>& settings);

}  // namespace rimline::tools
