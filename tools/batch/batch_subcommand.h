#pragma once

// What follows `--` in a batch: a subcommand that takes a model and ends by itself, and its options without the model.

#include <string>
#include <vector>

namespace rimline::tools {

/// Throws UsageError for what is wrong whatever the models are: no such subcommand, a second `--`, `--help`, an unknown
/// place, no -o where the subcommand needs one, or standard output, which is not one for each model.
void check_batch_subcommand(const std::vector<std::string>& words);

}  // namespace rimline::tools
