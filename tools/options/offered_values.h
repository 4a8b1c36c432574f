#pragma once

// Values that completion offers for options that take others too.

#include <string>
#include <string_view>
#include <vector>

namespace rimline::tools {

/// Of the name of a value in --help, as "X,Y,Z|VIEW|auto": words in small letters are values themselves, and VIEW, AXIS,
/// COLOR and PALETTE stand for all names of these. Each once.
std::vector<std::string> offered_values(std::string_view value);

/// Of all styles, each once. None without the engine, which draws with them.
std::vector<std::string> offered_palettes();

}  // namespace rimline::tools
