#include "engine/vulkan/rounding.h"

#include <doctest/doctest.h>

#include <cstdint>

namespace rimline {
namespace {

TEST_CASE("integers are rounded up to whole units") {
    CHECK(units_of(0u, 64u) == 0);
    CHECK(units_of(1u, 64u) == 1);
    CHECK(units_of(64u, 64u) == 1);
    CHECK(units_of(65u, 64u) == 2);
    CHECK(rounded_up(0u, 4u) == 0);
    CHECK(rounded_up(9u, 4u) == 12);
    CHECK(rounded_up<std::uint64_t>(std::uint64_t{1} << 40, 4) == std::uint64_t{1} << 40);
}

}  // namespace
}  // namespace rimline
