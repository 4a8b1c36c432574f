#include "silhouette/hough/box_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/plane_block.h"

namespace rimline {

namespace {

std::uint32_t blocks_of(std::uint32_t faces) { return (faces + k_block_size - 1) / k_block_size; }

// Lower and upper bound of g (v_sphere.h) over a box: each axis is a parabola, or a line. Roundings are far below
// the float at which a face bit is certain.
WalkedBox::Side side_of(const HoughBounds& box, const glm::dvec3& q, double w, double error) {
    double low = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double slope = q[static_cast<glm::length_t>(i)];
        const auto at = [&](double h) { return h * (w * h - slope); };
        const double bottom = w > 0.0 ? std::clamp(0.5 * slope / w, box.low[i], box.high[i])
                                      : (slope > 0.0 ? box.high[i] : box.low[i]);
        low += at(bottom);
        high += std::max(at(box.low[i]), at(box.high[i]));
    }
    if (high < -error) return WalkedBox::Side::inside;
    return low > error ? WalkedBox::Side::outside : WalkedBox::Side::straddles;
}

double reach_of(const HoughBounds& box) {
    double squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double farthest = std::max(-box.low[i], box.high[i]);
        squares += farthest * farthest;
    }
    return std::sqrt(squares);
}

}  // namespace

HoughBoxes::HoughBoxes(const HoughOctree& octree, std::size_t origin) {
    const std::vector<std::uint32_t>& faces = octree.statistics().group_faces;
    RIMLINE_CHECK(origin < octree.origins().size());
    origin_ = octree.origins()[origin];
    std::uint32_t first_block = 0;
    for (std::size_t i = 0; i < origin; ++i) first_block += blocks_of(faces[i]);
    std::vector<HoughBounds>& blocks =
        levels_.emplace_back(octree.block_count() > 0 ? blocks_of(faces[origin]) : 0);
    for (std::uint32_t block = 0; block < blocks.size(); ++block)
        for (std::uint32_t lane = 0; lane < k_block_size; ++lane) {
            const std::uint32_t position = (first_block + block) * k_block_size + lane;
            const FaceId face = octree.face_at(position);
            if (face != k_no_face)
                blocks[block].include(hough_point(octree.mesh().plane(face), origin_));
        }
    while (levels_.back().size() > 1) {
        const std::vector<HoughBounds>& below = levels_.back();
        std::vector<HoughBounds> level((below.size() + k_node_width - 1) / k_node_width);
        for (std::size_t i = 0; i < below.size(); ++i) level[i / k_node_width].include(below[i]);
        levels_.push_back(std::move(level));
    }
}

class HoughBoxes::Walk {
public:
    Walk(const HoughBoxes& boxes, const HomogeneousPoint& point)
        : levels_(boxes.levels_),
          w_(double{point.w}),
          q_(glm::dvec3(point.xyz()) - w_ * boxes.origin_),
          error_(0x1p-22 * glm::length(glm::dvec3(point.xyz()))) {}

    void enter(std::uint32_t height, std::size_t number) {
        const HoughBounds& box = levels_[height][number];
        const std::uint64_t width = std::uint64_t{1}
                                    << (3 * height);  // Blocks below: 8 to the height.
        const std::uint64_t first = number * width;
        glm::dvec3 low(box.low[0], box.low[1], box.low[2]);
        glm::dvec3 high(box.high[0], box.high[1], box.high[2]);
        found.push_back({.center = glm::vec3(0.5 * (low + high)),
                         .extent = glm::vec3(0.5 * (high - low)),
                         .side = side_of(box, q_, w_, error_ * reach_of(box)),
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
    const std::vector<std::vector<HoughBounds>>& levels_;
    double w_;
    glm::dvec3 q_;
    double error_;  // Times the reach of a box: where |g| is above it, face bits are certain.
};

std::vector<WalkedBox> HoughBoxes::walk(const HomogeneousPoint& point) const {
    Walk walk(*this, point);
    if (block_count() > 0) walk.enter(static_cast<std::uint32_t>(levels_.size() - 1), 0);
    return std::move(walk.found);
}

}  // namespace rimline
