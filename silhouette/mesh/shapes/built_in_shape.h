#pragma once

// Shapes that need no file, so that examples, tests and benches run anywhere: any name of
// `k_built_in_shapes`, with about as many faces as asked.

#include <array>
#include <cstdint>
#include <string_view>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// sphere, torus, knot (a (2,3) torus knot tube), box, spring (a capped helical tube): closed,
/// oriented outwards, two-manifold. terrain: an open height field. scene: what `rimline render` draws
/// without a model, several casters on a ground, one in another's shadow.
constexpr std::array<std::string_view, 7> k_built_in_shapes{"sphere", "torus",   "knot", "box",
                                                            "spring", "terrain", "scene"};

/// About `faces` triangles: within a factor of two for 100 or more, never fewer than the shape needs;
/// 0 takes the shape's own default. Up is y. The same on every machine.
/// `name` must be one of k_built_in_shapes. Throws Error{too_large} beyond 2^28 faces.
MeshSource make_built_in_shape(std::string_view name, std::uint32_t faces = 0);

}  // namespace rimline
