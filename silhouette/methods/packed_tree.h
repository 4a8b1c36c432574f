#pragma once

// The shape of all trees of this folder: complete, eight children a node, sixteen items a leaf, no pointers.
//
//     level 1   [ 0                       | 1             ]     node i has the children 8i .. 8i + 7
//     level 0   [ 0 | 1 | 2 | ... | 7     | 8 | 9 | ...   ]     leaf i has the items 16i .. 16i + 15
//     items     [ 16 | 16 | 16 | ...      |               ]     in packed_order
//
// The data of the nodes is stored in groups of eight siblings, as structures of arrays, so that one pass of
// vector instructions tests all eight. Only the last node of a level may have fewer children,
// and only the last leaf fewer items.

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace rimline {

constexpr std::uint32_t k_leaf_items = 16;
constexpr std::uint32_t k_fan_out = 8;

/// Four coordinates that define the distance of items.
using PackedKey = std::array<float, 4>;

/// An order in which the items of every node are close together: order[i] is the number of the item at
/// position i. Ranges are halved at a median of their widest axis, rounded to whole nodes. Keys may
/// coincide. Coordinates must be finite. O(n log n); the same on every machine.
std::vector<std::uint32_t> packed_order(std::span<const PackedKey> keys);

class PackedTree {
public:
    PackedTree() = default;
    explicit PackedTree(std::uint32_t item_count);

    std::uint32_t item_count() const noexcept { return item_count_; }
    std::uint32_t level_count() const noexcept {
        return static_cast<std::uint32_t>(levels_.size());
    }
    std::uint32_t node_count(std::uint32_t level) const noexcept { return levels_[level].nodes; }
    std::uint32_t group_count() const noexcept { return group_count_; }

    struct Range {
        std::uint32_t begin, end;
        std::uint32_t size() const noexcept { return end - begin; }
    };
    /// The items below a node.
    Range items_of(std::uint32_t level, std::uint32_t node) const noexcept {
        const auto end = (std::uint64_t{node} + 1) * levels_[level].items_a_node;
        return {node * levels_[level].items_a_node,
                end < item_count_ ? static_cast<std::uint32_t>(end) : item_count_};
    }
    /// The group of a node and its siblings. The node's lane is node % k_fan_out.
    std::uint32_t group_of(std::uint32_t level, std::uint32_t node) const noexcept {
        return levels_[level].first_group + node / k_fan_out;
    }

    /// A group of siblings during a traversal.
    struct Siblings {
        std::uint32_t group;
        std::uint32_t level;
        std::uint32_t first_node;
        std::uint32_t count;
        std::uint32_t lanes() const noexcept { return (1u << count) - 1; }
    };
    /// Traverses depth first. `enter(siblings)` returns a mask of the lanes whose nodes are entered;
    /// `visit(leaf)` is called for each leaf that is entered. Never allocates.
    template <typename Enter, typename Visit>
    void walk(Enter&& enter, Visit&& visit) const;

private:
    struct Level {
        std::uint32_t nodes;
        std::uint32_t first_group;
        std::uint32_t items_a_node;
    };
    // 16 * 8^10 items are more than 2^32. A traversal pops one group before it pushes up to eight.
    static constexpr std::uint32_t k_max_levels = 11;
    static constexpr std::uint32_t k_max_stack = (k_fan_out - 1) * k_max_levels + 1;

    Siblings siblings(std::uint32_t level, std::uint32_t first_node) const noexcept {
        const std::uint32_t rest = levels_[level].nodes - first_node;
        return {group_of(level, first_node), level, first_node,
                rest < k_fan_out ? rest : k_fan_out};
    }

    std::uint32_t item_count_ = 0;
    std::uint32_t group_count_ = 0;
    std::vector<Level> levels_;  // From the leaves up.
};

template <typename Enter, typename Visit>
void PackedTree::walk(Enter&& enter, Visit&& visit) const {
    if (levels_.empty()) return;
    struct Pending {
        std::uint32_t level, first_node;
    };
    std::array<Pending, k_max_stack> stack;
    std::uint32_t size = 0;
    stack[size++] = {level_count() - 1, 0};
    while (size > 0) {
        const Pending top = stack[--size];
        const Siblings group = siblings(top.level, top.first_node);
        for (std::uint32_t mask = enter(group); mask != 0; mask &= mask - 1) {
            const std::uint32_t node =
                group.first_node + static_cast<std::uint32_t>(std::countr_zero(mask));
            if (group.level == 0)
                visit(node);
            else
                stack[size++] = {group.level - 1, node * k_fan_out};
        }
    }
}

}  // namespace rimline
