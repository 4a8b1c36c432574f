#pragma once

// Measurements in tests: no progress is shown.

#include "tools/command.h"

namespace rimline::tools {

inline const Context k_quiet{true, {}};

}  // namespace rimline::tools
