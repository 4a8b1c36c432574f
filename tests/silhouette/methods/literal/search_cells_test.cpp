#include "silhouette/methods/literal/search_cells.h"

#include <doctest/doctest.h>

#include "tests/silhouette/methods/literal/octants.h"

namespace rimline {
namespace {

struct Walkable {
    explicit Walkable(std::uint32_t points)
        : octree(build_point_octree(tests::clustered_points(points, 5))),
          candidates(
              choose_active_set_candidates(octree.nodes, build_neighbor_graph(octree.nodes))),
          cells(build_search_cells(octree, candidates, 0.0)),
          octants(tests::octants_of(cells.cells, octree.root)) {}

    PointOctree octree;
    ActiveSetCandidates candidates;
    SearchCells cells;
    std::vector<Octant> octants;
};

TEST_CASE("tiles fill the root, and each point is in one of them") {
    const Walkable walkable(2000);
    double volume = 0.0;
    std::uint32_t points = 0;
    std::uint32_t empty = 0;
    std::size_t candidates = 0;
    for (std::size_t i = 0; i < walkable.cells.cells.size(); ++i) {
        const OctreeNode& cell = walkable.cells.cells[i];
        CHECK((cell.child_count == 0 || cell.child_count == 8));
        if (!cell.is_leaf()) continue;
        const glm::dvec3 extent = walkable.octants[i].high - walkable.octants[i].low;
        volume += extent.x * extent.y * extent.z;
        points += cell.size();
        const std::uint32_t node = walkable.cells.node_of[i];
        if (node == k_no_node) {
            ++empty;
            CHECK(cell.size() == 0);
        } else {
            CHECK(walkable.candidates.candidate_above[node] == node);
            ++candidates;
        }
    }
    CHECK(volume == 1.0);
    CHECK(points == walkable.octree.order.size());
    CHECK(candidates == walkable.candidates.candidates.size());
    CHECK(empty == walkable.cells.empty_tiles);
    CHECK(empty > 0);
}

TEST_CASE("boxes hold the octants, and know the root's faces that they touch") {
    const Walkable walkable(1000);
    for (std::size_t i = 0; i < walkable.cells.cells.size(); ++i) {
        const Octant& octant = walkable.octants[i];
        const HoughBox& box = walkable.cells.boxes[i];
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(double{box.low[static_cast<std::size_t>(axis)]} <= octant.low[axis]);
            CHECK(double{box.high[static_cast<std::size_t>(axis)]} >= octant.high[axis]);
            const unsigned faces = walkable.cells.root_faces[i];
            CHECK((faces >> (2 * axis) & 1u) == (octant.low[axis] == 0.0));
            CHECK((faces >> (2 * axis + 1) & 1u) == (octant.high[axis] == 1.0));
        }
    }
}

TEST_CASE("a tile's neighbors lie along all of its face, or are what covers it") {
    const Walkable walkable(1000);
    const SearchCells& cells = walkable.cells;
    for (std::size_t i = 0; i < cells.cells.size(); ++i) {
        if (!cells.cells[i].is_leaf()) continue;
        for (std::size_t direction = 0; direction < 6; ++direction) {
            const std::uint32_t neighbor = cells.neighbors[i][direction];
            if (neighbor == k_no_node) {
                CHECK((cells.root_faces[i] >> direction & 1u) == 1u);
                continue;
            }
            const int axis = static_cast<int>(direction) / 2;
            const bool high = direction % 2 == 1;
            const Octant& own = walkable.octants[i];
            const Octant& other = walkable.octants[neighbor];
            CHECK((high ? own.high : own.low)[axis] == (high ? other.low : other.high)[axis]);
            for (int k = 0; k < 3; ++k) {
                if (k == axis) continue;
                CHECK(other.low[k] <= own.low[k]);
                CHECK(other.high[k] >= own.high[k]);
            }
            if (!cells.cells[neighbor].is_leaf())
                CHECK(cells.cells[neighbor].depth == cells.cells[i].depth);
        }
    }
}

TEST_CASE("boxes are widened by the error") {
    const Walkable walkable(50);
    const SearchCells wide = build_search_cells(walkable.octree, walkable.candidates, 0.125);
    CHECK(wide.boxes[0].low[0] == -0.125f);
    CHECK(wide.boxes[0].high[2] == 1.125f);
    CHECK(build_search_cells({}, {}, 1.0).cells.empty());
}

}  // namespace
}  // namespace rimline
