#pragma once

// What `rimline bench lines --check` requires (docs/results/lines.md).

#include <vector>

#include "tools/bench/lines.h"
#include "tools/bench/targets.h"

namespace rimline::tools {

/// `result` has no difference. Without rays, targets that compare with them are left out.
std::vector<Target> targets_of(const LinesResult& result);

}  // namespace rimline::tools
