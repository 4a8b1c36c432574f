#pragma once

// Scripts that complete the program's command line in shells.

#include <string>

#include "tools/option_table.h"

namespace rimline::tools {

/// For bash 4 and later, to be sourced or installed in share/bash-completion/completions.
std::string bash_completion(const CommandRow& program);
/// For zsh, to be installed as _rimline in share/zsh/site-functions.
std::string zsh_completion(const CommandRow& program);
/// For fish, to be installed in share/fish/vendor_completions.d.
std::string fish_completion(const CommandRow& program);

}  // namespace rimline::tools
