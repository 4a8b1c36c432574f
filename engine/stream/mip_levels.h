#pragma once

// The mip levels of a texture.

#include <cstdint>
#include <vector>

#include "silhouette/picture.h"

namespace rimline {

/// A picture and its reductions, each half as wide and high as the one before, rounded down, to a single pixel. A
/// pixel is the mean of what it covers, in linear light. Those larger than `max_side` are left out. O(pixels).
std::vector<Picture> mip_levels(const Picture& picture, std::uint32_t max_side);

}  // namespace rimline
