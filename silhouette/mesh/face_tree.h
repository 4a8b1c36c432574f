#pragma once

// A balanced tree of boxes over the faces of a mesh: which faces a box may meet, and which a segment may meet.
//
// A node holds a range of faces, in the order of the tree. Its children hold one half each, in whole blocks of
// sixteen faces; below, in whole leaves of four. So all blocks and leaves but the last are full, there are no
// pointers, and the tree depends on the mesh alone.

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

struct FaceBox {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};

    void include(const FaceBox& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool meets(const FaceBox& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y && low.z <= other.high.z && other.low.z <= high.z;
    }
};

class FaceTree {
public:
    /// `mesh` must outlive the tree. O(n log n) on all threads of oneTBB. Throws Error{cancelled}.
    explicit FaceTree(const Mesh& mesh, const LongCall& call = {});

    /// The faces in the order of the tree. Neighbors in it are neighbors in space.
    std::span<const std::uint32_t> order() const noexcept { return order_; }
    FaceBox box_of(std::uint32_t face) const;

    /// Calls visit(face) for each face whose box meets `box`, in the order of the tree, until it returns true. Returns
    /// whether it did.
    template <typename Visit>
    bool any_meeting(const FaceBox& box, Visit&& visit) const {
        const auto is_outside = [&](const Node& node) { return !boxes_[node.number].meets(box); };
        return any_leaf(is_outside, [&](const Node& node) {
            for (std::uint32_t i = node.first; i < node.last; ++i)
                if (box_of(order_[i]).meets(box) && visit(order_[i])) return true;
            return false;
        });
    }

    /// Calls visit(face) for each face that the segment may meet, and for some others, until it returns true.
    /// Returns whether it did.
    template <typename Visit>
    bool any_along(const glm::dvec3& from, const glm::dvec3& to, Visit&& visit) const {
        const Segment segment(from, to);
        const auto is_outside = [&](const Node& node) {
            return !segment.may_meet(boxes_[node.number]);
        };
        return any_leaf(is_outside, [&](const Node& node) {
            for (std::uint32_t i = node.first; i < node.last; ++i)
                if (visit(order_[i])) return true;
            return false;
        });
    }
    /// The same for all of them.
    template <typename Visit>
    void each_along(const glm::dvec3& from, const glm::dvec3& to, Visit&& visit) const {
        any_along(from, to, [&](std::uint32_t face) {
            visit(face);
            return false;
        });
    }

    class Segments;  // face_tree_segments.h

    static constexpr std::uint32_t k_leaf_faces = 4;    ///< Of the last leaf: at most.
    static constexpr std::uint32_t k_block_faces = 16;  ///< Of the last block: at most.

    /// A range of faces in the order of the tree.
    struct Node {
        std::size_t number;
        std::uint32_t first, last;
        std::uint32_t size() const noexcept { return last - first; }
        /// Of a block: its place among all blocks.
        std::uint32_t block() const noexcept { return first / k_block_faces; }
    };
    struct NodePair {
        Node a, b;  ///< The same node twice, or two apart from each other.
    };
    /// Pairs of nodes of at most `max_faces` (k_block_faces or more) whose boxes meet, such that every pair of faces
    /// whose boxes meet is in one of them: to share the work of each_block_pair() among threads. Their order depends
    /// on the mesh alone.
    class NodePairs {
    public:
        /// `tree` must outlive this object.
        NodePairs(const FaceTree& tree, std::uint32_t max_faces);
        /// Sets `pairs` to the next ones, at most `count`; to none after the last.
        void next(std::size_t count, std::vector<NodePair>& pairs);
        /// The share that next() has given or left out: ascends from 0 to 1.
        double done() const noexcept { return std::min(done_, 1.0); }

    private:
        struct Open {
            NodePair pair;
            double share;
        };
        const FaceTree& tree_;
        std::uint32_t max_faces_;
        std::vector<Open> open_;  // A few for each level of the tree.
        double done_ = 0.0;
    };
    /// Calls visit(a, b) for each pair of blocks of the two nodes whose boxes meet, once; and, if the nodes are the
    /// same, for each block and itself. Leaves out those of two nodes, as large as they may be, that are_apart(a, b).
    template <typename AreApart, typename Visit>
    void each_block_pair(const NodePair& nodes, AreApart&& are_apart, Visit&& visit) const {
        const auto& [a, b] = nodes;
        if (a.number == b.number) {
            if (is_block(a)) return visit(a, a);
            const auto [low, high] = children_of(a);
            each_block_pair({low, low}, are_apart, visit);
            each_block_pair({high, high}, are_apart, visit);
            each_block_pair({low, high}, are_apart, visit);
            return;
        }
        if (!boxes_[a.number].meets(boxes_[b.number]) || are_apart(a, b)) return;
        if (is_block(a) && is_block(b)) return visit(a, b);
        if (is_block(b) || (!is_block(a) && a.size() >= b.size())) {
            for (const Node& child : children_of(a)) each_block_pair({child, b}, are_apart, visit);
        } else {
            for (const Node& child : children_of(b)) each_block_pair({a, child}, are_apart, visit);
        }
    }
    template <typename Visit>
    void each_block_pair(const NodePair& nodes, Visit&& visit) const {
        each_block_pair(
            nodes, [](const Node&, const Node&) { return false; }, visit);
    }

    /// A value of each node that is a block or larger, by its number: of_block(node), and joined(value, value) of the
    /// values of its children.
    template <typename Value, typename OfBlock, typename Joined>
    std::vector<Value> values_of_nodes(OfBlock&& of_block, Joined&& joined) const {
        std::vector<Value> values(boxes_.size());
        const auto set = [&](const auto& self, const Node& node) -> const Value& {
            if (is_block(node)) return values[node.number] = of_block(node);
            const auto [low, high] = children_of(node);
            const Value& one = self(self, low);
            return values[node.number] = joined(one, self(self, high));
        };
        if (!order_.empty()) set(set, Node{0, 0, static_cast<std::uint32_t>(order_.size())});
        return values;
    }

private:
    // A segment, prepared for tests of boxes that are wider than its rounding errors.
    struct Segment {
        Segment(const glm::dvec3& from, const glm::dvec3& to);
        bool may_meet(const FaceBox& box) const noexcept {
            double begin = 0.0, end = 1.0;
            for (int i = 0; i < 3; ++i) {
                const double p = (double{box.low[i]} - behind[i]) * inverse[i];
                const double q = (double{box.high[i]} - before[i]) * inverse[i];
                begin = std::max(begin, std::min(p, q));
                end = std::min(end, std::max(p, q));
            }
            return begin <= end + 0x1p-44;
        }
        // Its begin, moved by the margin along all axes, up and down.
        glm::dvec3 behind, before;
        glm::dvec3 inverse;
    };
    static bool is_leaf(const Node& node) noexcept { return node.size() <= k_leaf_faces; }
    static bool is_block(const Node& node) noexcept { return node.size() <= k_block_faces; }
    static std::array<Node, 2> children_of(const Node& node) noexcept {
        const std::uint32_t middle = middle_of(node.first, node.last);
        return {
            {{2 * node.number + 1, node.first, middle}, {2 * node.number + 2, middle, node.last}}};
    }
    static std::uint32_t middle_of(std::uint32_t first, std::uint32_t last) {
        const std::uint32_t unit = last - first > k_block_faces ? k_block_faces : k_leaf_faces;
        return first + (last - first + unit - 1) / unit / 2 * unit;
    }

    template <typename IsOutside, typename Leaf>
    bool any_leaf(IsOutside&& is_outside, Leaf&& leaf) const {
        std::array<Node, 64> stack;  // The tree has at most 2^30 faces: 31 levels.
        std::size_t size = 0;
        Node node{0, 0, static_cast<std::uint32_t>(order_.size())};
        if (is_outside(node)) return false;
        for (;;) {
            if (is_leaf(node)) {
                if (leaf(node)) return true;
            } else {
                const auto [low, high] = children_of(node);
                const bool has_low = !is_outside(low), has_high = !is_outside(high);
                if (has_low && has_high) stack[size++] = high;
                if (has_low || has_high) {
                    node = has_low ? low : high;
                    continue;
                }
            }
            if (size == 0) return false;
            node = stack[--size];
        }
    }

    class Builder;

    const Mesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<FaceBox> boxes_;
};

}  // namespace rimline
