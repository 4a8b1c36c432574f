#include "silhouette/hough/box_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/hough/rounded_float.h"

namespace rimline {

namespace {

void set_child(BoxNode& node, std::uint32_t lane, const HoughBounds& box) {
    double squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto center = static_cast<float>(0.5 * (box.low[i] + box.high[i]));
        const float extent =
            rounded_up(std::max(box.high[i] - double{center}, double{center} - box.low[i]));
        node.center[i][lane] = center;
        node.extent[i][lane] = extent;
        const double farthest = std::abs(double{center}) + double{extent};
        squares += farthest * farthest;
    }
    node.reach[lane] = rounded_up(std::sqrt(squares) * (1.0 + 0x1p-50));
}

BoxNode empty_node() {
    BoxNode node;
    for (std::uint32_t lane = 0; lane < k_node_width; ++lane) {
        for (int i = 0; i < 3; ++i)
            node.center[i][lane] = node.extent[i][lane] = std::numeric_limits<float>::quiet_NaN();
        node.reach[lane] = std::numeric_limits<float>::quiet_NaN();
    }
    return node;
}

}  // namespace

BoxTree::BoxTree(std::vector<HoughBounds> blocks)
    : block_count_(static_cast<std::uint32_t>(blocks.size())) {
    if (blocks.empty()) return;
    for (const HoughBounds& box : blocks) {
        RIMLINE_CHECK(!box.is_empty());
        const glm::dvec3 size(box.high[0] - box.low[0], box.high[1] - box.low[1],
                              box.high[2] - box.low[2]);
        mean_block_radius_ += 0.5 * glm::length(size);
    }
    mean_block_radius_ /= static_cast<double>(blocks.size());

    std::vector<std::vector<BoxNode>> levels;  // The lowest first.
    while (levels.empty() || levels.back().size() > 1) {
        std::vector<BoxNode>& level =
            levels.emplace_back((blocks.size() + k_node_width - 1) / k_node_width, empty_node());
        std::vector<HoughBounds> parents(level.size());
        tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
            const std::size_t end = std::min(blocks.size(), (i + 1) * k_node_width);
            for (std::size_t child = i * k_node_width; child < end; ++child) {
                set_child(level[i], static_cast<std::uint32_t>(child % k_node_width),
                          blocks[child]);
                parents[i].include(blocks[child]);
            }
        });
        blocks = std::move(parents);
    }
    BoxNode root = empty_node();
    set_child(root, 0, blocks.front());
    max_reach_ = root.reach[0];
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        nodes_.insert(nodes_.end(), level->begin(), level->end());
        level_begin_.push_back(node_count());
    }
}

BoxQuery::BoxQuery(const HomogeneousPoint& point, const glm::dvec3& origin,
                   float max_reach) noexcept
    : BoxQuery(between(point, point, origin, max_reach)) {}

BoxQuery BoxQuery::between(const HomogeneousPoint& from, const HomogeneousPoint& to,
                           const glm::dvec3& origin, float max_reach) noexcept {
    RIMLINE_CHECK(from.w == to.w);
    const glm::dvec3 a(from.xyz());
    const glm::dvec3 b(to.xyz());
    const glm::dvec3 shift = double{to.w} * origin;
    const double point_length = std::max(glm::length(a), glm::length(b));
    const double longest = std::max(glm::length(a - shift), glm::length(b - shift));
    const double half_step = 0.5 * glm::length(b - a);
    const glm::dvec3 center = 0.5 * (a + b) - shift;
    BoxQuery query;
    query.w = to.w;
    for (int i = 0; i < 3; ++i) query.q[i] = static_cast<float>(center[i]);
    query.margin = rounded_up(half_step * (1.0 + 0x1p-20) + 0x4p-24 * point_length +
                              0x20p-24 * (longest + double{max_reach}));
    return query;
}

// A thick v-sphere for both points needs one test where two v-spheres need two. But it contains up to twice
// as much as differs between the two, and does not tell what certainly flips. Measured: it is faster up to
// steps of six (igea) to twelve (bunny) times the radius of a block's box.
bool is_small_step(const HomogeneousPoint& from, const HomogeneousPoint& to,
                   const BoxTree& tree) noexcept {
    constexpr double k_thick_step = 6.0;
    if (from.w != to.w) return false;
    const double step = glm::length(glm::dvec3(to.xyz()) - glm::dvec3(from.xyz()));
    return step <= k_thick_step * tree.mean_block_radius();
}

}  // namespace rimline
