#include "silhouette/hough/box_walk.h"

#include <algorithm>

#include "silhouette/hough/block_set.h"
#include "silhouette/hough/hough_point.h"

namespace rimline {

namespace {

WalkedBox::Side side_of(VSphereSide side) {
    switch (side) {
        case VSphereSide::inside: return WalkedBox::Side::inside;
        case VSphereSide::outside: return WalkedBox::Side::outside;
        case VSphereSide::mixed: break;
    }
    return WalkedBox::Side::straddles;
}

}  // namespace

HoughBoxes::HoughBoxes(const HoughOctree& octree, std::size_t origin) {
    const std::vector<std::uint32_t>& faces = octree.statistics().group_faces;
    RIMLINE_CHECK(origin < octree.origins().size());
    origin_ = octree.origins()[origin];
    std::uint32_t first_block = 0;
    for (std::size_t i = 0; i < origin; ++i) first_block += block_count_of(faces[i]);
    std::vector<HoughBox>& blocks = levels_.emplace_back(block_count_of(faces[origin]));
    for (std::uint32_t block = 0; block < blocks.size(); ++block)
        for (std::uint32_t lane = 0; lane < k_block_size; ++lane) {
            const std::uint32_t position = (first_block + block) * k_block_size + lane;
            const FaceId face = octree.face_at(position);
            if (face != k_no_face)
                blocks[block].include(hough_point(octree.mesh().plane(face), origin_));
        }
    while (levels_.back().size() > 1) {
        const std::vector<HoughBox>& below = levels_.back();
        std::vector<HoughBox> level((below.size() + k_node_width - 1) / k_node_width);
        for (std::size_t i = 0; i < below.size(); ++i) level[i / k_node_width].include(below[i]);
        levels_.push_back(std::move(level));
    }
}

class HoughBoxes::Walk {
public:
    Walk(const HoughBoxes& boxes, const HomogeneousPoint& point)
        : levels_(boxes.levels_),
          sphere_(point, boxes.origin_, boxes.levels_.back().front().reach()) {}

    void enter(std::uint32_t height, std::size_t number) {
        const HoughBox& box = levels_[height][number];
        const std::uint64_t width = std::uint64_t{1} << (3 * height);  // Blocks below.
        const std::uint64_t first = number * width;
        const glm::vec3 low(box.low[0], box.low[1], box.low[2]);
        const glm::vec3 high(box.high[0], box.high[1], box.high[2]);
        found.push_back({.center = 0.5f * (low + high),
                         .extent = 0.5f * (high - low),
                         .side = side_of(sphere_.side_of(box, box.reach())),
                         .height = height,
                         .first_block = static_cast<std::uint32_t>(first),
                         .block_count = static_cast<std::uint32_t>(
                             std::min(width, levels_.front().size() - first))});
        if (found.back().is_end()) return;
        const std::size_t end = std::min((number + 1) * k_node_width, levels_[height - 1].size());
        for (std::size_t child = number * k_node_width; child < end; ++child)
            enter(height - 1, child);
    }

    std::vector<WalkedBox> found;

private:
    const std::vector<std::vector<HoughBox>>& levels_;
    VSphere sphere_;
};

std::vector<WalkedBox> HoughBoxes::walk(const HomogeneousPoint& point) const {
    if (block_count() == 0) return {};
    Walk walk(*this, point);
    walk.enter(static_cast<std::uint32_t>(levels_.size() - 1), 0);
    return std::move(walk.found);
}

}  // namespace rimline
