#pragma once

// The points that `rimline track` follows, one a frame: an orbit, a random walk, or a file's.

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// `frames` points on the orbit around the mesh's center (silhouette/hough/orbit.h), the first at angle
/// 0, each `step_degrees` further. `radius` is in the mesh's radii. Throws UsageError when the orbit
/// leaves the range of coordinates.
std::vector<HomogeneousPoint> orbit_path(const Mesh& mesh, glm::vec3 up, double radius,
                                         double step_degrees, std::uint32_t frames);

/// What trackers find hard, mixed: jumps anywhere within three radii, steps from a millionth to a tenth
/// of the radius, steps back to an earlier point, vertices of the mesh, the center, directions, far
/// points, and standing still. The same for the same seed on every machine.
std::vector<HomogeneousPoint> random_path(const Mesh& mesh, std::uint32_t seed,
                                          std::uint32_t frames);

/// One point a line, `x y z` or `x y z w` with w 1 (a viewpoint) or 0 (a direction), the numbers apart by
/// blanks, by a comma or by both; empty lines, and what follows a #, are skipped. Throws
/// Error{bad_input} naming file and line, Error{io} for what is no regular file or cannot be read,
/// Error{too_large} where it does not fit in memory.
std::vector<HomogeneousPoint> read_path(const std::string& file_name, const LongCall& call);

}  // namespace rimline::tools
