#pragma once

// Points spread evenly over a mesh, its border included: what a cloud looks like after a resampling such as
// WLOP, which the thesis applied to its raw clouds (5.3).

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

struct EvenSamples {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint8_t> is_border;
};

/// About `count` points on the faces and border edges, no two nearer than a common distance, and no place
/// farther from one than about that. Darts are thrown: first at the border edges, then at the faces. The
/// same for the same mesh. O(count) expected.
EvenSamples even_samples(const Mesh& mesh, std::uint32_t count);

}  // namespace rimline::tools
