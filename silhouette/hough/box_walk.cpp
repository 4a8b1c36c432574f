#include "silhouette/hough/box_walk.h"

#include <algorithm>
#include <cmath>

#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"

namespace rimline {

namespace {

std::uint32_t blocks_of(std::uint32_t faces) { return (faces + k_block_size - 1) / k_block_size; }

WalkedBox::Side side_of(const BoxNode& node, std::uint32_t lane, const BoxQuery& query) {
    double value = 0.0;
    double range = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double c = node.center[axis][lane];
        const double e = node.extent[axis][lane];
        value += c * (query.w * c - query.q[axis]);
        range += e * (std::abs(2.0 * query.w * c - query.q[axis]) + query.w * e);
    }
    range += double{node.reach[lane]} * query.margin + query.min_margin;
    if (std::abs(value) <= range) return WalkedBox::Side::straddles;
    return value < 0.0 ? WalkedBox::Side::inside : WalkedBox::Side::outside;
}

class Walk {
public:
    Walk(const BoxTree& tree, const BoxQuery& query) : tree_(tree), query_(query) {}

    void enter(std::uint32_t level, std::uint32_t number) {
        const BoxNode& node = tree_.level(level)[number];
        const std::uint32_t height = tree_.level_count() - 1 - level;
        for (std::uint32_t lane = 0; lane < k_node_width; ++lane) {
            if (std::isnan(node.reach[lane])) continue;
            const std::uint32_t child = number * k_node_width + lane;
            const WalkedBox::Side side = side_of(node, lane, query_);
            // Blocks below: 8 to the power of height.
            const std::uint64_t width = std::uint64_t{1} << (3 * height);
            const std::uint64_t first = child * width;
            boxes.push_back(
                {.center = {node.center[0][lane], node.center[1][lane], node.center[2][lane]},
                 .extent = {node.extent[0][lane], node.extent[1][lane], node.extent[2][lane]},
                 .side = side,
                 .height = height,
                 .first_block = static_cast<std::uint32_t>(first),
                 .block_count =
                     static_cast<std::uint32_t>(std::min(width, tree_.block_count() - first))});
            if (!boxes.back().is_end()) enter(level + 1, child);
        }
    }

    std::vector<WalkedBox> boxes;

private:
    const BoxTree& tree_;
    const BoxQuery& query_;
};

}  // namespace

BoxTree make_face_tree(const HoughOctree& octree, std::size_t origin) {
    const std::vector<std::uint32_t>& faces = octree.statistics().group_faces;
    RIMLINE_CHECK(origin < octree.origins().size());
    std::uint32_t first_block = 0;
    for (std::size_t i = 0; i < origin; ++i) first_block += blocks_of(faces[i]);
    std::vector<HoughBounds> bounds(octree.block_count() > 0 ? blocks_of(faces[origin]) : 0);
    for (std::uint32_t block = 0; block < bounds.size(); ++block)
        for (std::uint32_t lane = 0; lane < k_block_size; ++lane) {
            const std::uint32_t position = (first_block + block) * k_block_size + lane;
            const FaceId face = octree.face_at(position).face;
            if (face != k_no_face)
                bounds[block].include(
                    hough_point(octree.mesh().plane(face), octree.origins()[origin]));
        }
    return BoxTree(std::move(bounds));
}

std::vector<WalkedBox> walk_boxes(const BoxTree& tree, const BoxQuery& query) {
    Walk walk(tree, query);
    if (tree.block_count() > 0) walk.enter(0, 0);
    return std::move(walk.boxes);
}

}  // namespace rimline
