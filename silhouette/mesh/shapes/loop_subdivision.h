#pragma once

// Loop's subdivision: each step splits every triangle into four and smooths.
//
// Positions use Loop's weights (C. Loop, Smooth Subdivision Surfaces Based on Triangles, 1987) with
// Warren's simpler beta; borders and non-manifold edges follow the cubic B-spline of the border, as do
// edges where more than two faces meet, so open and non-manifold meshes refine without cracks.

#include <cstdint>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// `steps` refinements of `source`, welded first (equal positions are one vertex); 4^steps times the
/// faces. Throws Error{too_large} when the result would pass 2^28 faces.
MeshSource subdivide_loop(const MeshSource& source, std::uint32_t steps, const LongCall& call = {});

}  // namespace rimline
