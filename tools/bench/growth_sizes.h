#pragma once

// The growing meshes of --growth.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

/// A model to load.
struct GrowthSize {
    std::string model;
    std::uint32_t subdivide;
};

/// Smallest first. For shape:NAME, with FACES or without, sizes of 1, 3, 10, 30, .. thousand in the range, as near
/// as the shape allows. For a file, the file and its subdivisions in the range. Throws UsageError where the range
/// has no size.
std::vector<GrowthSize> growth_sizes(const std::string& model, std::uint32_t min_faces,
                                     std::uint32_t max_faces, const Context& context);

}  // namespace rimline::tools
