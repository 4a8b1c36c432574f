#include "silhouette/methods/literal/search_cells.h"

namespace rimline {

namespace {

constexpr std::uint8_t k_all_root_faces = 0b111111;

// Those of the root's faces touched by a parent that the child touches too.
std::uint8_t root_faces_of_child(std::uint8_t parents, std::uint32_t octant) {
    std::uint8_t kept = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
        kept |= static_cast<std::uint8_t>(1u << (2 * axis + (octant >> axis & 1u)));
    return parents & kept;
}

class CellBuilder {
public:
    CellBuilder(const PointOctree& octree, const ActiveSetCandidates& candidates, double error)
        : octree_(octree), candidates_(candidates), error_(error) {}

    std::uint32_t add(std::uint32_t node, std::uint32_t depth, const Octant& octant,
                      std::uint8_t root_faces) {
        const auto number = static_cast<std::uint32_t>(result.cells.size());
        OctreeNode cell{{}, 0, 0, depth, 0};
        cell.children.fill(k_no_node);
        if (node != k_no_node) {
            cell.begin = octree_.nodes[node].begin;
            cell.end = octree_.nodes[node].end;
        } else {
            ++result.empty_tiles;
        }
        HoughBox box;
        box.include(HoughPoint{octant.low, error_, 0});
        box.include(HoughPoint{octant.high, error_, 0});
        result.cells.push_back(cell);
        result.node_of.push_back(node);
        result.boxes.push_back(box);
        result.reaches.push_back(box.reach());
        result.root_faces.push_back(root_faces);
        if (node == k_no_node || candidates_.candidate_above[node] != k_no_node) return number;

        cell.child_count = 8;
        for (std::uint32_t i = 0; i < 8; ++i)
            cell.children[i] = add(octree_.nodes[node].children[i], depth + 1, octant.child(i),
                                   root_faces_of_child(root_faces, i));
        result.cells[number] = cell;
        return number;
    }

    SearchCells result;

private:
    const PointOctree& octree_;
    const ActiveSetCandidates& candidates_;
    double error_;
};

}  // namespace

SearchCells build_search_cells(const PointOctree& octree, const ActiveSetCandidates& candidates,
                               double error) {
    CellBuilder builder(octree, candidates, error);
    if (!octree.nodes.empty()) builder.add(0, 0, octree.root, k_all_root_faces);
    builder.result.neighbors = build_neighbor_graph(builder.result.cells);
    return std::move(builder.result);
}

}  // namespace rimline
