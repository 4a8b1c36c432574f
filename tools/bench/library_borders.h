#pragma once

// The borders that PCL's BoundaryEstimation and Open3D's compute_boundary_points find, by library_borders.py,
// where they are installed: what users of point cloud libraries have instead.

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

/// At several settings each; none where neither is installed. `positions` are rounded to floats. Another
/// program reads them all. Throws Error{cancelled}.
std::vector<LibraryBorders> library_borders(std::span<const glm::dvec3> positions,
                                            const Context& context);

}  // namespace rimline::tools
