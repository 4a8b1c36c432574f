#include "silhouette/hough/service/latest_value.h"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <utility>

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

// A value that lets something else happen when half of it is copied.
struct Interrupted {
    int first = 0;
    int second = 0;
    static inline std::function<void()> interruption;

    Interrupted() = default;
    explicit Interrupted(int value) : first(value), second(value) {}
    Interrupted& operator=(const Interrupted& other) noexcept {
        first = other.first;
        if (interruption) std::exchange(interruption, nullptr)();
        second = other.second;
        return *this;
    }
};

TEST_CASE(
    "neither a stop half way through reading nor one half way through writing is in the way") {
    for (int before = 1; before <= 4; ++before) {
        CAPTURE(before);
        LatestValue<Interrupted> box;
        for (int i = 1; i <= before; ++i) box.store(Interrupted(i));
        Interrupted value;
        Interrupted::interruption = [&] {
            for (int i = 11; i <= 15; ++i) box.store(Interrupted(i));
        };
        REQUIRE(box.take(value));
        CHECK(value.first == before);
        CHECK(value.second == before);

        Interrupted::interruption = [&] {
            Interrupted meanwhile;
            CHECK(box.take(meanwhile));
            CHECK(meanwhile.first == 15);
            CHECK(meanwhile.second == 15);
            CHECK(!box.take(meanwhile));
        };
        CHECK(!box.store(Interrupted(16)));
        REQUIRE(box.take(value));
        CHECK(value.first == 16);
        CHECK(value.second == 16);
    }
}

TEST_CASE("a reader meets no half of a value and nothing older than what it has seen") {
    using Wide = std::array<std::uint64_t, 16>;
    LatestValue<Wide> box;
    const std::uint64_t last = 100'000;
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
