#pragma once

// Union-find over numbers, with path halving. Joined sets keep the lower root, so the numbers of sets do not depend on
// the order of joins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rimline {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    /// Returns true if two sets became one.
    bool join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return false;
        parent_[std::max(a, b)] = std::min(a, b);
        return true;
    }
    /// Of each element the number of its set: 0, 1, 2, ... in the order of their first elements. No joins afterwards.
    std::vector<std::uint32_t> take_numbers() {
        std::uint32_t count = 0;
        // A parent is never greater than its child, so its number is already set.
        for (std::uint32_t i = 0; i < parent_.size(); ++i)
            parent_[i] = parent_[i] == i ? count++ : parent_[parent_[i]];
        return std::move(parent_);
    }

private:
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    std::vector<std::uint32_t> parent_;
};

}  // namespace rimline
