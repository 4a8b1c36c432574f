#pragma once

// The borders that PCL's BoundaryEstimation and Open3D's compute_boundary_points find, where they are
// installed (library_borders.py). They are the alternative of users of point cloud libraries.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

struct LibraryBorders {
    std::string method;  ///< Library, neighbors, threshold in degrees: "Open3D 16 90".
    std::vector<std::uint8_t> is_border;
};

/// Several settings of each library, or 16 neighbors at 120 degrees alone; none where neither is installed. Open3D's
/// search radius is at most ten times what contains the neighbors of most points. `positions` are rounded to floats and
/// passed to another program. Throws Error{cancelled}.
std::vector<LibraryBorders> library_borders(std::span<const glm::dvec3> positions,
                                            bool has_all_settings, const Context& context);

}  // namespace rimline::tools
