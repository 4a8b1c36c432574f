#pragma once

// The thesis's two ways to follow a moving silhouette point (3.4.2, 3.4.3), with its counts.
//
// Both find the faces whose Hough points may lie in the active region, set their bits, and examine the
// edges of those that turned (the edge list of 3.3.2). A node certainly contained in the region turns
// all its faces, untested, as 3.4.4 says; 3.4.2 and 3.4.3 would test them, which `contained_faces`
// counts.
//
//   full traversal   Starts at the root and enters every node whose PBV is not certainly apart from the
//                    region.
//
//   incremental      Walks breadth-first from the active set, the tiles (search_cells.h) that may meet the
//                    previous v-sphere, to neighbors whose OBV may meet the region, and searches within
//                    them as above. The tiles that may meet the new v-sphere are the next active set.
//
// Why the walk is complete. Let Z be the thin shell around a v-sphere where bits are uncertain, and A the
// active region with the shells of both v-spheres. Every face that turns has its point in A. From any point
// of A a path within A leads to the previous v-sphere's shell: along the ray from the origin, inwards if the
// point is outside the previous v-sphere, outwards if it is inside, since every such ray is inside a v-sphere
// up to one place and outside from there on. (A point in the new v-sphere's shell moves to that v-sphere
// first. Where the place is infinitely far, the v-sphere is the plane of a direction, and the path goes
// around to it far out, or into the origin, which lies on both.) The path crosses adjacent tiles that meet A.
// If it stays within the root, it ends in a tile of the active set; if not, it leaves through a tile at the
// root's boundary. So the walk starts from both: from the active set, and from the tiles at the boundary that
// meet A, which are found from the root by their OBVs. These lie along curves and are few.
//
// The text starts from the active set only, tests PBVs, and has no empty octants. `incremental_as_written`
// shows the faces that it misses: those that are reached only across empty octants, such as the octants
// around the origin of a sphere; those where the region enters the root from outside; and, once the active
// set is empty, all. Its silhouettes are wrong. It exists to count its work.
//
// Cost of the walk. It is meant to avoid the nodes near the root, but PBVs make those few. Boxes a move
// on the bunny (69k faces, radius 2, steps of 1°):
//
//     faces a leaf    full traversal    as written    walk
//           1              2,957           3,496     10,693
//          32              1,493           1,510      1,680
//
// Of the walk's 9,700 octants 2,671 are empty octants that it must cross, and 4,141 are beside the region. A
// walk that continued only to the facing side of a divided neighbor tested 4% fewer.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/methods/followed_silhouette.h"
#include "silhouette/methods/literal/active_region.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "silhouette/methods/literal/literal_octree.h"

namespace rimline {

enum class LiteralUpdate : std::uint8_t { full_traversal, incremental, incremental_as_written };

struct LiteralTrackerOptions {
    LiteralUpdate update = LiteralUpdate::incremental;
    /// If false, a node contained in the region is searched like any other node that meets it.
    bool turn_contained_nodes = true;
};

class LiteralTracker {
public:
    /// Extracts the silhouette from `point` (3.4.1), tests every face, and finds the first active set.
    /// `octree` must outlive the tracker and stay where it is.
    LiteralTracker(const LiteralOctree& octree, const HomogeneousPoint& point,
                   const LiteralTrackerOptions& options = {});
    LiteralTracker(LiteralOctree&&, const HomogeneousPoint&,
                   const LiteralTrackerOptions& = {}) = delete;  // It would dangle.

    /// Moves to `point` and returns the work of this move. One thread at a time.
    const LiteralCounters& move_to(const HomogeneousPoint& point);

    const HomogeneousPoint& point() const noexcept { return point_; }
    /// In no particular order. Valid until the tracker moves, like the other spans.
    std::span<const EdgeId> silhouette() const noexcept { return followed_.edges(); }
    std::span<const std::uint32_t> face_words() const noexcept { return followed_.face_words(); }
    /// The faces that turned in the last move, each once.
    std::span<const FaceId> turned() const noexcept { return turned_; }
    /// The number of tiles, or of nodes for `incremental_as_written`, that the next move starts from; 0 for
    /// full traversal.
    std::size_t active_set_size() const noexcept { return active_.size(); }
    /// The work of the last move, or of the construction before the first move.
    const LiteralCounters& counters() const noexcept { return counters_; }

private:
    void begin_active_set();
    void begin_active_set(const ActiveRegion& region, std::uint32_t cell);
    void begin_active_set_as_written(const VSphere& sphere, std::uint32_t node);
    void walk(const ActiveRegion& region);
    void walk_as_written(const ActiveRegion& region);

    void enqueue_boundary(const ActiveRegion& region, std::uint32_t cell);
    void enqueue(std::uint32_t vertex);
    RegionSides sides_of_cell(const ActiveRegion& region, std::uint32_t cell);

    void search(const ActiveRegion& region, std::uint32_t node);
    void search_as_written(const ActiveRegion& region, std::uint32_t node);
    void turn_node(const OctreeNode& node, VSphereSide side);
    void check_faces(const OctreeNode& node);
    void set_bit(FaceId face, bool front);

    const LiteralOctree* octree_;
    LiteralTrackerOptions options_;
    HomogeneousPoint point_;
    LiteralCounters counters_;

    FollowedSilhouette followed_;
    std::vector<FaceId> turned_;

    // The walk. Cells that a move has tested or enqueued have the number of the move.
    std::vector<std::uint32_t> active_;
    std::vector<std::uint32_t> next_active_;
    std::vector<std::uint32_t> queue_;
    std::vector<std::uint64_t> tested_at_;
    std::vector<std::uint64_t> enqueued_at_;
    std::vector<RegionSides> sides_;  // Where tested_at_ is this move.
    std::uint64_t move_ = 0;
};

}  // namespace rimline
