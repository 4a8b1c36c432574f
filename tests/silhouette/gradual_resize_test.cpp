#include "silhouette/gradual_resize.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <stop_token>
#include <vector>

namespace rimline {
namespace {

// Asks for a stop when so many have been made.
struct Counted {
    static inline std::uint32_t made = 0, stop_at = 0;
    static inline std::stop_source stop;
    std::uint64_t value = 7;

    Counted() = default;
    Counted(const Counted& other) : value(other.value) {
        if (++made == stop_at) stop.request_stop();
    }
    Counted& operator=(const Counted&) = default;
};

TEST_CASE("a vector that grows gradually has the size and the values that are asked") {
    std::vector<std::uint32_t> values{1, 2};
    resize_gradually(values, 2000000, {}, 5u);
    REQUIRE(values.size() == 2000000);
    CHECK(values[1] == 2);
    CHECK(values[2] == 5);
    CHECK(values.back() == 5);
    resize_gradually(values, 3, {});
    CHECK(values.size() == 2000000);  // It only grows.
}

TEST_CASE("a vector stops growing where that is asked") {
    std::vector<Counted> values;
    Counted::made = 0;
    Counted::stop_at = 300000;
    Counted::stop = {};
    ErrorCode code{};
    try {
        resize_gradually(values, 5000000, Counted::stop.get_token());
    } catch (const Error& error) {
        code = error.code();
    }
    CHECK(code == ErrorCode::cancelled);
    CHECK(values.size() < 800000);
}

}  // namespace
}  // namespace rimline
