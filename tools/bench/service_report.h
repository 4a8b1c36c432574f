#pragma once

// The result of `rimline bench service` as a table on standard output and as JSON.

#include <nlohmann/json_fwd.hpp>

#include "tools/bench/service.h"

namespace rimline::tools {

void print_result(const ServiceResult& result);
nlohmann::ordered_json to_json(const ServiceResult& result);

}  // namespace rimline::tools
