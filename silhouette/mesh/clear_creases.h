#pragma once

// Creases that stand out: the edges that a pen would draw of a surface which also has noise.
//
// Where a scan is rough, many edges bend by as much as the edges of a machine part do, but each for itself. A
// crease that stands out differs in two ways:
//
//   clear   The face on either side goes on flat: another edge of it hardly bends. Or it is a face of a polyhedron:
//           it bends the same way at all edges. Of the creases of scans, a fifth to a half of the length is clear; of
//           those of machine parts, all.
//   strong  Edges that go on straight into each other form a chain that is long, or short and sharp: the sum over
//           its edges of length * (bend / 30 degrees)^2 is at least 15% of the radius of the part of the mesh that
//           edges connect with it: a small house in a large scene has its edges. At a vertex of more than 1024 creases
//           none goes on into another.
//
// A chain stands out when it is strong and at least 70% of its length is clear.

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/creases.h"

namespace rimline {

/// Those of `creases` that stand out, in their order. `creases` are of find_creases(): all that bend by some angle;
/// 30 degrees is a good one. Throws Error{cancelled} when `stop` is requested. O(n log n), and
/// as StraightestPairs at vertices of many creases.
std::vector<Crease> clear_creases(const Mesh& mesh, std::span<const Crease> creases,
                                  const std::stop_token& stop = {});

/// A flag for each edge that bends by `min_bend_rad` and stands out, for LineOptions::shown_creases. Errors and cost as
/// find_creases() and clear_creases().
std::vector<std::uint8_t> clear_crease_flags(const Mesh& mesh, float min_bend_rad,
                                             const std::stop_token& stop = {});

}  // namespace rimline
