#include "engine/vulkan/timestamps.h"

#include <doctest/doctest.h>

namespace rimline {
namespace {

TEST_CASE("a time between timestamps counts ticks, and a counter may wrap around once") {
    const TimestampUnit whole{.valid_bits = 64, .tick_ms = 0.5};
    CHECK(whole.elapsed_ms(10, 10) == 0.0);
    CHECK(whole.elapsed_ms(10, 14) == 2.0);
    CHECK(whole.elapsed_ms(~std::uint64_t{0}, 1) == 1.0);
    const TimestampUnit narrow{.valid_bits = 36, .tick_ms = 0.5};
    CHECK(narrow.elapsed_ms((std::uint64_t{1} << 36) - 2, 4) == 3.0);
    CHECK(narrow.elapsed_ms(4, 10) == 3.0);
    CHECK(TimestampUnit{}.elapsed_ms(4, 10) == 0.0);
}

}  // namespace
}  // namespace rimline
