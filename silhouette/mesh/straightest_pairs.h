#pragma once

// Which of the lines that meet at a point go on into each other: those that bend least, pair by pair.
//
// Of all pairs of lines that bend by at most an angle, the straightest is taken, then the straightest of those that
// are left, and so on. Of pairs that bend alike the first is taken. Each line is in one pair at most.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

namespace rimline {

class StraightestPairs {
public:
    /// Where more lines meet than this, none is paired: the spine of a fan of thousands of faces is no line that a pen
    /// would follow through, and all pairs would take too long.
    static constexpr std::size_t k_max_ways = 1024;

    /// Calls take(i, j), i < j, for each pair. `ways` are directions of length 1 away from the point, and `max_cos` is
    /// the greatest cosine between two of a pair: -1 where they go straight on. A way that is NaN is in no pair.
    /// O(n^2 log n) time for n ways and O(n^2) memory, of at most k_max_ways; O(1) for more.
    template <typename Way, typename Take>
    void each(std::span<const Way> ways, double max_cos, Take&& take) {
        if (ways.size() > k_max_ways) return;
        found_.clear();
        for (std::uint32_t i = 0; i < ways.size(); ++i)
            for (std::uint32_t j = i + 1; j < ways.size(); ++j) {
                const double cos = glm::dot(ways[i], ways[j]);
                if (cos <= max_cos) found_.push_back({cos, i, j});
            }
        pairs_ += ways.size() * (ways.size() - 1) / 2;
        std::ranges::sort(found_, [](const Found& a, const Found& b) {
            if (a.cos != b.cos) return a.cos < b.cos;
            return a.i != b.i ? a.i < b.i : a.j < b.j;
        });
        is_taken_.assign(ways.size(), 0);
        for (const auto& [cos, i, j] : found_) {
            if (is_taken_[i] != 0 || is_taken_[j] != 0) continue;
            is_taken_[i] = is_taken_[j] = 1;
            take(std::size_t{i}, std::size_t{j});
        }
    }

    /// How many pairs were compared so far: the work done, for checkpoints.
    std::uint64_t pairs() const noexcept { return pairs_; }

private:
    struct Found {
        double cos;
        std::uint32_t i, j;
    };
    std::vector<Found> found_;
    std::vector<std::uint8_t> is_taken_;
    std::uint64_t pairs_ = 0;
};

}  // namespace rimline
