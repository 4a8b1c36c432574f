#include "engine/vulkan/range_allocator.h"

#include <doctest/doctest.h>

#include <map>
#include <random>
#include <vector>

namespace rimline {
namespace {

TEST_CASE("parts do not overlap, are aligned, and are joined again when they are free") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        constexpr std::uint64_t k_size = 1 << 16;
        RangeAllocator allocator(k_size);
        std::vector<RangeAllocator::Part*> used;
        std::map<std::uint64_t, std::uint64_t> ranges;  // Begin and end.
        std::uint64_t sum = 0;
        const auto free_one = [&] {
            std::swap(used[random() % used.size()], used.back());
            sum -= used.back()->size();
            ranges.erase(used.back()->offset());
            allocator.free(*used.back());
            used.pop_back();
        };
        for (int step = 0; step < 3000; ++step) {
            if (random() % 5 < 2 && !used.empty()) {
                free_one();
                continue;
            }
            const std::uint64_t size = 1 + random() % (random() % 4 == 0 ? 6000 : 200);
            const std::uint64_t alignment = std::uint64_t{1} << random() % 9;
            RangeAllocator::Part* const part = allocator.allocate(size, alignment);
            if (!part) {
                // Nothing that is free could hold it.
                std::uint64_t begin = 0;
                const auto holds = [&](std::uint64_t end) {
                    const std::uint64_t aligned = (begin + alignment - 1) / alignment * alignment;
                    return aligned + size <= end;
                };
                for (const auto& [first, last] : ranges) {
                    REQUIRE_FALSE(holds(first));
                    begin = last;
                }
                REQUIRE_FALSE(holds(k_size));
                continue;
            }
            const std::uint64_t begin = part->offset();
            REQUIRE(part->size() == size);
            REQUIRE(begin % alignment == 0);
            REQUIRE(begin + size <= k_size);
            const auto next = ranges.lower_bound(begin);
            if (next != ranges.end()) REQUIRE(begin + size <= next->first);
            if (next != ranges.begin()) REQUIRE(std::prev(next)->second <= begin);
            ranges[begin] = begin + size;
            used.push_back(part);
            sum += size;
            REQUIRE(allocator.used_size() == sum);
            // Between two used parts there is at most one that is free.
            REQUIRE(allocator.part_count() <= 2 * used.size() + 1);
        }
        while (!used.empty()) free_one();
        CHECK(allocator.used_size() == 0);
        CHECK(allocator.part_count() == 1);
        const RangeAllocator::Part* const whole = allocator.allocate(k_size, 1);
        REQUIRE(whole);
        CHECK(whole->offset() == 0);
        CHECK_FALSE(allocator.allocate(1, 1));
    }
}

}  // namespace
}  // namespace rimline
