#pragma once

// Draws numbers with given probabilities, each in constant time, from a generator of random bits.
//
// A. Walker, An Efficient Method for Generating Discrete Random Variables with General Distributions,
// ACM TOMS 1977: n columns of equal height. Each column belongs to one number and at
// most one other.

#include <cstdint>
#include <span>
#include <vector>

namespace rimline {

/// SplitMix64 (Steele, Lea, Flood 2014). Gives the same numbers on every machine, unlike the standard
/// library's distributions.
class RandomBits {
public:
    explicit RandomBits(std::uint64_t seed) noexcept : state_(seed) {}

    std::uint64_t next() noexcept {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }

private:
    std::uint64_t state_;
};

class AliasTable {
public:
    AliasTable() = default;
    /// Weights must be positive and their sum finite. O(weights).
    explicit AliasTable(std::span<const double> weights);

    bool is_empty() const noexcept { return columns_.empty(); }
    /// Returns i with probability weights[i] / sum. The table must not be empty.
    std::uint32_t draw(RandomBits& random) const noexcept {
        // The high half chooses the column, the low half one of its two numbers.
        const std::uint64_t bits = random.next();
        const auto at = static_cast<std::uint32_t>((bits >> 32) * columns_.size() >> 32);
        const Column& column = columns_[at];
        return static_cast<std::uint32_t>(bits) < column.own ? at : column.other;
    }

private:
    struct Column {
        std::uint32_t
            own;  // In units of 2^-32. A full column has 1 - 2^-32, and itself as `other`.
        std::uint32_t other;
    };
    std::vector<Column> columns_;
};

}  // namespace rimline
