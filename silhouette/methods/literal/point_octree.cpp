#include "silhouette/methods/literal/point_octree.h"

#include <algorithm>
#include <numeric>

#include "silhouette/error.h"

namespace rimline {

namespace {

std::uint32_t octant_of(const glm::dvec3& point, const glm::dvec3& center) {
    std::uint32_t octant = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (point[axis] >= center[axis]) octant |= 1u << axis;
    return octant;
}

class Builder {
public:
    Builder(std::span<const glm::dvec3> points, const PointOctreeOptions& options,
            PointOctree& octree)
        : points_(points), options_(options), octree_(octree), scratch_(points.size()) {}

    // Returns the number of the new node. Recursion is as deep as the tree, max_depth at most.
    std::uint32_t add(std::uint32_t begin, std::uint32_t end, std::uint32_t depth,
                      const Octant& octant) {
        const auto number = static_cast<std::uint32_t>(octree_.nodes.size());
        OctreeNode node{{}, begin, end, depth, 0};
        node.children.fill(k_no_node);
        octree_.nodes.push_back(node);
        if (node.size() <= options_.bucket_size || depth >= options_.max_depth ||
            all_equal(begin, end))
            return number;

        const std::array<std::uint32_t, 9> parts = partition(begin, end, octant.center());
        for (std::uint32_t i = 0; i < 8; ++i) {
            if (parts[i] == parts[i + 1]) continue;
            node.children[i] = add(parts[i], parts[i + 1], depth + 1, octant.child(i));
            ++node.child_count;
        }
        octree_.nodes[number] = node;
        return number;
    }

private:
    bool all_equal(std::uint32_t begin, std::uint32_t end) const {
        const glm::dvec3& first = points_[octree_.order[begin]];
        return std::all_of(octree_.order.begin() + begin, octree_.order.begin() + end,
                           [&](std::uint32_t point) { return points_[point] == first; });
    }

    // Sorts the points of a node by octant, stably. Octant i then has [parts[i], parts[i + 1]).
    std::array<std::uint32_t, 9> partition(std::uint32_t begin, std::uint32_t end,
                                           const glm::dvec3& center) {
        std::array<std::uint32_t, 9> parts{};
        for (std::uint32_t i = begin; i < end; ++i)
            ++parts[octant_of(points_[octree_.order[i]], center) + 1];
        parts[0] = begin;
        std::partial_sum(parts.begin(), parts.end(), parts.begin());
        std::array<std::uint32_t, 9> next = parts;
        for (std::uint32_t i = begin; i < end; ++i)
            scratch_[next[octant_of(points_[octree_.order[i]], center)]++] = octree_.order[i];
        std::copy(scratch_.begin() + begin, scratch_.begin() + end, octree_.order.begin() + begin);
        return parts;
    }

    std::span<const glm::dvec3> points_;
    const PointOctreeOptions& options_;
    PointOctree& octree_;
    std::vector<std::uint32_t> scratch_;
};

}  // namespace

Octant Octant::child(std::uint32_t octant) const noexcept {
    const glm::dvec3 middle = center();
    Octant part;
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_high = (octant >> axis & 1u) != 0;
        part.low[axis] = is_high ? middle[axis] : low[axis];
        part.high[axis] = is_high ? high[axis] : middle[axis];
    }
    return part;
}

PointOctree build_point_octree(std::span<const glm::dvec3> points,
                               const PointOctreeOptions& options) {
    RIMLINE_CHECK(options.bucket_size > 0);
    PointOctree octree;
    if (points.empty()) return octree;
    octree.root = {points[0], points[0]};
    for (const glm::dvec3& point : points)
        for (int axis = 0; axis < 3; ++axis) {
            octree.root.low[axis] = std::min(octree.root.low[axis], point[axis]);
            octree.root.high[axis] = std::max(octree.root.high[axis], point[axis]);
        }
    octree.order.resize(points.size());
    std::iota(octree.order.begin(), octree.order.end(), 0u);
    Builder(points, options, octree)
        .add(0, static_cast<std::uint32_t>(points.size()), 0, octree.root);
    return octree;
}

std::vector<std::uint32_t> leaf_depth_histogram(std::span<const OctreeNode> nodes) {
    std::vector<std::uint32_t> histogram;
    for (const OctreeNode& node : nodes) {
        if (!node.is_leaf()) continue;
        if (node.depth >= histogram.size()) histogram.resize(node.depth + 1, 0);
        ++histogram[node.depth];
    }
    return histogram;
}

}  // namespace rimline
