#pragma once

// The octree and the tracker against the definition, over many points of one mesh.

#include <cstdint>

#include "silhouette/hough/hough_octree.h"

namespace rimline::tests {

/// Fails the running test case unless extraction equals brute force from each of `points` points.
void check_extraction(const HoughOctree& octree, std::uint32_t points, std::uint64_t seed);

/// Fails the running test case unless the tracker and all its change sets are right after each of
/// `moves` moves.
void check_walk(const HoughOctree& octree, std::uint32_t moves, std::uint64_t seed);

}  // namespace rimline::tests
