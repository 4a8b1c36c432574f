#pragma once

// The command line that draws a picture again: the user's own options of `render`, with a camera and lights that are
// given completely instead of chosen.

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace rimline::tools {

/// A number that parses to the same value. A float is parsed as options are: as a double that is rounded.
std::string exact_text(float value);
std::string exact_text(double value);

/// `text` as one word of a POSIX shell.
std::string quoted_for_shell(const std::string& text);

/// `rimline render`, `models`, quoted for a shell, then the options of `app` that were given and that `render` has with the same meaning, but
/// for those of camera and light and the output; then `arguments`, words that need no quotes.
std::string render_command(const CLI::App& app, const std::string& models,
                           const std::vector<std::string>& arguments);

}  // namespace rimline::tools
