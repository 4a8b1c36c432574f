#pragma once

// Options whose value is a list of names: `--lines silhouette,border`.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli_classes.h"

namespace rimline::tools {

/// Calls set(numbers of the given names, in their order). The description is followed by the names. A name that
/// is unknown or given twice is a usage error, and so is an empty list. `names` must outlive parsing.
CLI::Option* add_name_list(CLI::App& app, const std::string& option,
                           std::span<const std::string_view> names,
                           std::function<void(const std::vector<std::size_t>&)> set,
                           const std::string& description);

}  // namespace rimline::tools
