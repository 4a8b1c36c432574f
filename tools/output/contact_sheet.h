#pragma once

// A grid of pictures of the same size, row by row from the upper left, with a gap around each.

#include <cstdint>
#include <span>

#include "silhouette/picture.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

/// The number of columns of a nearly square grid: the ceiling of the square root. 0 for no pictures.
std::uint32_t contact_sheet_columns(std::size_t pictures);

/// At least one picture, all of the same size (RIMLINE_CHECK). Gaps and empty cells have this color.
/// The sheet has alpha if the first picture has it.
Picture make_contact_sheet(std::span<const Picture> pictures, std::uint32_t columns,
                           std::uint32_t gap, const Color& color);

}  // namespace rimline::tools
