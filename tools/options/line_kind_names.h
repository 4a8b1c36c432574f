#pragma once

// The names of the kinds of lines, in options and files.

#include <array>
#include <string_view>

#include "silhouette/lines/line_drawing.h"

namespace rimline::tools {

/// By LineKind.
constexpr std::array<std::string_view, k_line_kinds> k_line_kind_names{"silhouette", "border",
                                                                       "crease", "intersection"};

}  // namespace rimline::tools
