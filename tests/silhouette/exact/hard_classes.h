#pragma once

// Over a hundred classes of hard meshes, small enough for exact arithmetic.

#include <cstdint>
#include <vector>

#include "tests/silhouette/hough/support/hard_meshes.h"

namespace rimline::tests {

/// One mesh a class, of at most about 300 faces: every kind of generated_meshes.h, the small ones of hard_meshes.h and
/// the built-in shapes; and of each four states: as it is; on a coarse lattice, where most things coincide; broken
/// (difficult_meshes.h); and through a moved copy of itself. `round` gives others of the same classes.
std::vector<NamedSource> hard_classes(std::uint32_t round = 0);

}  // namespace rimline::tests
