#include "silhouette/hough/interleaved_bits.h"

#include <doctest/doctest.h>

#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

std::uint64_t bit_by_bit(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    std::uint64_t code = 0;
    for (std::uint32_t b = 0; b < 21; ++b)
        code |=
            (x >> b & 1u) << 3 * b | (y >> b & 1u) << (3 * b + 1) | (z >> b & 1u) << (3 * b + 2);
    return code;
}

TEST_CASE("interleaved bits are those of three coordinates in turn") {
    constexpr std::uint64_t k_all = (std::uint64_t{1} << 21) - 1;
    CHECK(interleaved_bits(0, 0, 0) == 0);
    CHECK(interleaved_bits(k_all, 0, 0) == 0x1249249249249249u);
    CHECK(interleaved_bits(k_all, k_all, k_all) == 0x7fffffffffffffffu);
    for (std::uint32_t b = 0; b < 21; ++b) {
        const std::uint64_t bit = std::uint64_t{1} << b;
        CHECK(interleaved_bits(bit, 0, 0) == std::uint64_t{1} << 3 * b);
        CHECK(interleaved_bits(0, bit, 0) == std::uint64_t{1} << (3 * b + 1));
        CHECK(interleaved_bits(0, 0, bit) == std::uint64_t{1} << (3 * b + 2));
    }
    tests::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t x = random.below(1u << 21), y = random.below(1u << 21),
                            z = random.below(1u << 21);
        CHECK(interleaved_bits(x, y, z) == bit_by_bit(x, y, z));
    }
}

}  // namespace
}  // namespace rimline
