#pragma once

// Pictures of one size side by side: row by row, in reading order, with a gap around each.

#include <cstdint>
#include <span>

#include "silhouette/picture.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

/// How many columns suit so many pictures: rows are as long as columns or one longer. 0 for none.
std::uint32_t contact_sheet_columns(std::size_t pictures);

/// One picture or more, all of the same size (RIMLINE_CHECK). What holds no picture has the color.
Picture make_contact_sheet(std::span<const Picture> pictures, std::uint32_t columns,
                           std::uint32_t gap, const Color& color);

}  // namespace rimline::tools
