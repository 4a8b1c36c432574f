#include "silhouette/unset_vector.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cstdint>

namespace rimline {
namespace {

long first_touched_pages() {
    rusage usage{};
    REQUIRE(getrusage(RUSAGE_SELF, &usage) == 0);
    return usage.ru_minflt;
}

TEST_CASE("an unset vector that grows touches no page of its own" * doctest::test_suite("plain")) {
    UnsetVector<std::uint64_t> values;
    const long before = first_touched_pages();
    values.resize(std::size_t{1} << 23);  // 64 MiB.
    CHECK(first_touched_pages() - before < 64);
    values.back() = 7;
    CHECK(values.back() == 7);
}

TEST_CASE("an unset vector takes values as others do and keeps them as it grows") {
    UnsetVector<std::uint32_t> values(3, 5u);
    values.push_back(6);
    values.resize(std::size_t{1} << 20);
    CHECK(values[0] == 5);
    CHECK(values[3] == 6);
    values.resize((std::size_t{1} << 20) + 2, 8u);
    CHECK(values.back() == 8);
}

}  // namespace
}  // namespace rimline
