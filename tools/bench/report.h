#pragma once

// How results of `rimline bench hough` are shown: tables for people, objects for scripts.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "tools/bench/hough.h"
#include "tools/bench/targets.h"

namespace rimline::tools {

void print_result(const ModelResult& result);

/// The model itself, without its cases.
nlohmann::ordered_json model_json(const ModelResult& result);
/// Its cases, as an array.
nlohmann::ordered_json cases_json(const ModelResult& result);
nlohmann::ordered_json to_json(const Target& target, const std::string& model);

/// A line of names for print_row.
void print_row_names();
/// One method beside the first of its table.
void print_row(const Times& times, const Times& ours);
nlohmann::ordered_json to_json(const Times& times, const Times& ours);

}  // namespace rimline::tools
