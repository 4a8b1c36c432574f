#pragma once

// The command line that draws a picture again: the user's own options of `render`, with a camera and lights
// that are given completely instead of chosen.

#include <string>
#include <vector>

#include "tools/cli_classes.h"
#include "tools/options/exact_text.h"

namespace rimline::tools {

/// `rimline render`, `models`, quoted for a shell, then the options of `app` that were given and that `render`
/// has with the same meaning, but for those of camera and light and the output; then `arguments`, words that
/// need no quotes.
std::string render_command(const CLI::App& app, const std::string& models,
                           const std::vector<std::string>& arguments);

}  // namespace rimline::tools
