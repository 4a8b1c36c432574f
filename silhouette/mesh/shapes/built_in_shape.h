#pragma once

// Shapes that need no file, for examples, tests and benchmarks. `k_built_in_shapes` lists their
// names. A caller can request an approximate number of faces.
//
//     sphere   unit sphere, a geodesic one         spring   helical tube around y, ends rounded
//     torus    around y, radii 1 and 0.4           terrain  height field over [-1, 1]^2, open
//     knot     tube around the (2,3) torus knot    scene    several casters on a slab, one in
//     box      [-1, 1]^3                                    another's shadow
//
// All except terrain and scene are closed, oriented outwards, two-manifold and free of
// self-intersections. Scene has these properties, too, except that some of its parts may intersect
// slightly.

#include <array>
#include <cstdint>
#include <string_view>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

constexpr std::array<std::string_view, 7> k_built_in_shapes{"sphere", "torus",   "knot", "box",
                                                            "spring", "terrain", "scene"};

/// About `faces` triangles: within a factor of two for 100 or more (scene: 1,000), but never fewer
/// than the shape needs. 0 selects the shape's default. Up is y. The result is equal, bit for bit, on
/// every machine. `name` must be in k_built_in_shapes. Throws Error{too_large} beyond 2^28 faces.
MeshSource make_built_in_shape(std::string_view name, std::uint32_t faces = 0);

}  // namespace rimline
