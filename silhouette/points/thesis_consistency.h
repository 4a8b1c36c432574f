#pragma once

// The third pass of the thesis for one point (5.2.5): its boundary edges are made consistent with those of its
// neighbors. A boundary edge is an end of a gap. It is returned where the neighbor has a boundary edge to the
// point, and then that edge is incoming.
//
//   accepted   A point whose boundary edges are all shared by two umbrellas does not change: smooth patches
//              meet there, or a crease ends. Nor does a point whose open boundary edges are all returned.
//   opened     A point without boundary, which at least two points that are not accepted lead to, opens
//              between two of these edges that follow each other in its ring and have neighbors between.
//   moved      An umbrella has an open boundary edge that is not returned, and edges to keep: incoming ones
//              and, in addition to these, its shared ones. Its gap moves between two edges to keep that follow
//              each other. One end of it is a shared edge, if there is any.
//   contained  The same where one incoming edge is all that is to keep. It replaces one end of the gap. If it
//              is an end already, the umbrella does not change.
//   filled     Without incoming edges the gap is filled with reciprocal edges: those to neighbors that have
//              the point in their umbrellas. Beside a shared edge a sector stays open.
//
// Of the places for a new gap the one is taken where the fewest neighbors with reciprocal edges are removed;
// of equal ones where the fewest neighbors are; then the widest. What was a gap and is no longer has triangles
// between its reciprocal edges. Gaps of the umbrella whose ends are all returned or shared stay.
//
// Of a point with several umbrellas these change one after another, until no open boundary edge is left. Each
// has the neighbors in its ring, the open boundary edges of the others, and those neighbors in no ring that
// are nearest to its plane. One that gets whole is dropped or replaces the others, as in the second pass.

#include <cstdint>
#include <optional>

#include "silhouette/points/neighborhood.h"
#include "silhouette/points/point_fans.h"

namespace rimline {

/// Of a point's k nearest neighbors, by place, as the second pass left them.
struct NeighborClaims {
    std::uint64_t reciprocal = 0;  ///< They have the point in an umbrella.
    std::uint64_t incoming = 0;    ///< They have it at the end of a gap.
    std::uint64_t opening = 0;     ///< The same, and they have open boundary edges.

    /// Adds those of the neighbor at `place`, which has the point at place `at` of its own list.
    void add(std::size_t place, const PointFans& of_neighbor, std::size_t at) noexcept;
};

/// Nothing where the point does not change.
std::optional<PointFans> made_consistent(const Neighborhood& around, const PointFans& fans,
                                         const NeighborClaims& claims);

}  // namespace rimline
