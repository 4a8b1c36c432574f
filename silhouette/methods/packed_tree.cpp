#include "silhouette/methods/packed_tree.h"

#include <algorithm>
#include <limits>

#include "silhouette/error.h"

namespace rimline {

namespace {

struct KeyedItem {
    PackedKey key;
    std::uint32_t item;
};

std::size_t widest_axis(std::span<const KeyedItem> items) {
    PackedKey low;
    PackedKey high;
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
    for (const KeyedItem& item : items)
        for (std::size_t k = 0; k < low.size(); ++k) {
            low[k] = std::min(low[k], item.key[k]);
            high[k] = std::max(high[k], item.key[k]);
        }
    std::size_t widest = 0;
    for (std::size_t k = 1; k < low.size(); ++k)
        if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
    return widest;
}

// `unit` is the number of items of a node: of a leaf, then eight times as many at each level.
void arrange(std::span<KeyedItem> items, std::size_t unit) {
    while (items.size() <= unit && unit > k_leaf_items) unit /= k_fan_out;
    if (items.size() <= unit) return;
    const std::size_t nodes = (items.size() + unit - 1) / unit;
    const std::size_t middle = nodes / 2 * unit;
    const std::size_t axis = widest_axis(items);
    // Ties are broken by number: the order of equal keys must not depend on a library's nth_element.
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle),
                     items.end(), [axis](const KeyedItem& a, const KeyedItem& b) {
                         return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis]
                                                           : a.item < b.item;
                     });
    arrange(items.first(middle), unit);
    arrange(items.subspan(middle), unit);
}

}  // namespace

std::vector<std::uint32_t> packed_order(std::span<const PackedKey> keys) {
    std::vector<KeyedItem> items(keys.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {keys[i], i};
    std::size_t unit = k_leaf_items;
    while (unit * k_fan_out < items.size()) unit *= k_fan_out;
    arrange(items, unit);
    // Sorted by number within a leaf: the order that nth_element leaves depends on the library.
    for (std::size_t begin = 0; begin < items.size(); begin += k_leaf_items) {
        const auto leaf = std::span(items).subspan(
            begin, std::min<std::size_t>(k_leaf_items, items.size() - begin));
        std::sort(leaf.begin(), leaf.end(),
                  [](const KeyedItem& a, const KeyedItem& b) { return a.item < b.item; });
    }
    std::vector<std::uint32_t> order;
    order.reserve(items.size());
    for (const KeyedItem& item : items) order.push_back(item.item);
    return order;
}

PackedTree::PackedTree(std::uint32_t item_count) : item_count_(item_count) {
    std::uint32_t items_a_node = k_leaf_items;
    std::uint32_t nodes = item_count / k_leaf_items + (item_count % k_leaf_items != 0);
    while (nodes > 0) {
        levels_.push_back({nodes, group_count_, items_a_node});
        const std::uint32_t groups = (nodes + k_fan_out - 1) / k_fan_out;
        group_count_ += groups;
        if (groups == 1) break;
        nodes = groups;
        items_a_node *= k_fan_out;
    }
    RIMLINE_CHECK(levels_.size() <= k_max_levels);
}

}  // namespace rimline
