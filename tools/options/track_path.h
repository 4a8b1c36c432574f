#pragma once

// Paths of a silhouette point or a camera, one point per frame: an orbit, a random walk, or a file.

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// `frames` points on the orbit around the mesh's center (silhouette/hough/orbit.h). The first is at angle
/// `start_rad`; each next one is `step_degrees` further. `radius` is in the mesh's radii. Throws UsageError if the
/// orbit leaves the range of coordinates.
std::vector<HomogeneousPoint> orbit_path(const Mesh& mesh, glm::vec3 up, double radius,
                                         double step_degrees, std::uint32_t frames,
                                         double start_rad = 0.0);

/// A mix of hard cases for trackers: jumps within three radii, steps from a millionth to a tenth of the
/// radius, earlier points again, vertices of the mesh, the center, directions, far points, and no motion.
/// The same seed gives the same points on every machine.
std::vector<HomogeneousPoint> random_path(const Mesh& mesh, std::uint32_t seed,
                                          std::uint32_t frames);

/// Reads one point per line: `x y z` or `x y z w`, with w = 1 for a viewpoint and w = 0 for a direction.
/// Numbers are separated by blanks, a comma or both. Empty lines are skipped, and so is text after a #.
/// Throws Error{bad_input} with file and line, Error{io} if it cannot be read or is not a regular file, and
/// Error{too_large} if it does not fit in memory.
std::vector<HomogeneousPoint> read_path(const std::string& file_name, const LongCall& call);

}  // namespace rimline::tools
