#pragma once

// The manual page of the program, rimline(1).

#include <string>

#include "tools/option_table.h"

namespace rimline::tools {

/// In roff with the macros of man(7). `version` is "0.1.0".
std::string manual_page(const CommandRow& program, const std::string& version);

}  // namespace rimline::tools
