#pragma once

#include <functional>
#include <string>

#include "silhouette/error.h"

namespace rimline::tools {

/// Work in several parts takes a BeginCall. It calls it before each part with the name of the task, and
/// passes the result to that part.
using BeginCall = std::function<LongCall(const std::string& task)>;

}  // namespace rimline::tools
