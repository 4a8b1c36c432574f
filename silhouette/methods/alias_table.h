#pragma once

// Draws a number with a given probability for each, in constant time, and the random bits for it.
//
// A. Walker, An Efficient Method for Generating Discrete Random Variables with General Distributions,
// ACM TOMS 1977: n columns of equal height, each shared by one number and at most one other.

#include <cstdint>
#include <span>
#include <vector>

namespace rimline {

/// SplitMix64 (Steele, Lea, Flood 2014): the same on every machine, which the standard library's
/// distributions are not.
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
    /// Weights are positive and their sum finite. O(weights).
    explicit AliasTable(std::span<const double> weights);

    bool is_empty() const noexcept { return columns_.empty(); }
    /// Number i with probability weights[i] / sum. There must be one.
    std::uint32_t draw(RandomBits& random) const noexcept {
        // The high half chooses the column, the low half who of the two in it.
        const std::uint64_t bits = random.next();
        const auto at = static_cast<std::uint32_t>((bits >> 32) * columns_.size() >> 32);
        const Column& column = columns_[at];
        return static_cast<std::uint32_t>(bits) < column.own ? at : column.other;
    }

private:
    struct Column {
        std::uint32_t own;  // In 2^-32; at most 1 - 2^-32, in which case `other` is the column too.
        std::uint32_t other;
    };
    std::vector<Column> columns_;
};

}  // namespace rimline
