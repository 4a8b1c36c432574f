#pragma once

// The tables and the JSON of `rimline bench lines`.

#include <nlohmann/json_fwd.hpp>

#include "tools/bench/lines.h"

namespace rimline::tools {

void print_result(const LinesResult& result);
nlohmann::ordered_json to_json(const LinesResult& result);

}  // namespace rimline::tools
