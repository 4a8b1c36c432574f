#pragma once

// The targets of `rimline bench hough --check`.
//
// Three meshes have goals of their own, known by their number of faces: the Stanford bunny, igea, and igea
// subdivided twice. For any other mesh, extraction and updates must not be slower than brute force.

#include <vector>

#include "tools/bench/hough.h"
#include "tools/bench/targets.h"

namespace rimline::tools {

/// `result` must be without a difference.
std::vector<Target> targets_of(const ModelResult& result);

}  // namespace rimline::tools
