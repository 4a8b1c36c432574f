#include "silhouette/hough/service/latest_value.h"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace rimline {
namespace {

TEST_CASE("what was stored last is taken once") {
    LatestValue<int> box;
    int value = -1;
    CHECK(!box.has_unread());
    CHECK(!box.take(value));
    CHECK(value == -1);
    CHECK(!box.store(1));
    CHECK(box.has_unread());
    CHECK(box.store(2));
    CHECK(box.store(3));
    CHECK(box.take(value));
    CHECK(value == 3);
    CHECK(!box.take(value));
    CHECK(!box.store(4));
    CHECK(box.take(value));
    CHECK(value == 4);
}

TEST_CASE("a reader meets no half of a value and nothing older than what it has seen") {
    // Large, so that reading takes as long as several writes of a writer in the wrong place.
    using Wide = std::array<std::uint64_t, 256>;
    LatestValue<Wide> box;
    const std::uint64_t last = 40'000;
    std::uint64_t superseded = 0;
    std::atomic<std::uint64_t> seen{0};
    std::thread writer([&] {
        Wide value;
        for (std::uint64_t i = 1; i <= last; ++i) {
            value.fill(i);
            superseded += box.store(value);
            if (i == 100) seen.wait(0);  // Until both are running.
        }
    });
    std::uint64_t taken = 0;
    std::uint64_t torn = 0;
    std::uint64_t backwards = 0;
    Wide now{};
    while (seen != last) {
        if (!box.take(now)) {
            std::this_thread::yield();
            continue;
        }
        ++taken;
        for (const std::uint64_t part : now) torn += part != now[0];
        backwards += now[0] <= seen;
        seen = now[0];
        seen.notify_one();
    }
    writer.join();
    CHECK(torn == 0);
    CHECK(backwards == 0);
    CHECK(taken + superseded == last);
}

}  // namespace
}  // namespace rimline
