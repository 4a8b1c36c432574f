#pragma once

// The options of the command as callers of other languages know them: by names without dashes before them.

#include <string>

namespace rimline::tools {

/// A message of the command, with `line-width` for `--line-width`, and `joint` for the dashes within a name.
std::string with_plain_names(std::string message, char joint);

}  // namespace rimline::tools
