#pragma once

// Shapes that need no file, so that examples, tests and benches run anywhere: any name of
// `k_built_in_shapes`, with about as many faces as asked.
//
//     sphere   unit sphere, a geodesic one         spring   helical tube around y, ends rounded
//     torus    around y, radii 1 and 0.4           terrain  height field over [-1, 1]^2, open
//     knot     tube around the (2,3) torus knot    scene    several casters on a slab, one in
//     box      [-1, 1]^3                                    another's shadow
//
// All but terrain and scene are closed, oriented outwards, two-manifold and free of
// self-intersections. Scene is each of these too, except that its parts rest in one another by a
// hair.

#include <array>
#include <cstdint>
#include <string_view>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

constexpr std::array<std::string_view, 7> k_built_in_shapes{"sphere", "torus",   "knot", "box",
                                                            "spring", "terrain", "scene"};

/// About `faces` triangles: within a factor of two for 100 or more (scene: 1,000), never fewer than
/// the shape needs; 0 takes the shape's own default. Up is y. The same, bit for bit, on every
/// machine. `name` must be one of k_built_in_shapes. Throws Error{too_large} beyond 2^28 faces.
MeshSource make_built_in_shape(std::string_view name, std::uint32_t faces = 0);

}  // namespace rimline
