#pragma once

// The results of `rimline bench hough` as tables on standard output and as JSON.

#include <nlohmann/json_fwd.hpp>

#include "tools/bench/hough.h"

namespace rimline::tools {

void print_result(const ModelResult& result);

/// The model without its cases.
nlohmann::ordered_json model_json(const ModelResult& result);
/// An array of its cases.
nlohmann::ordered_json cases_json(const ModelResult& result);

/// Prints the names of the columns of print_row().
void print_row_names();
/// Prints one method. `ours` is the first of its table.
void print_row(const Times& times, const Times& ours);
nlohmann::ordered_json to_json(const Times& times, const Times& ours);

}  // namespace rimline::tools
