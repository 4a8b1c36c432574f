#include "silhouette/mesh/disjoint_sets.h"

#include <doctest/doctest.h>

namespace rimline {
namespace {

TEST_CASE("joined sets are numbered by their first elements whatever the order of joins") {
    DisjointSets sets(7);
    CHECK(sets.join(6, 2));
    CHECK(sets.join(5, 3));
    CHECK(sets.join(2, 4));
    CHECK_FALSE(sets.join(4, 6));
    CHECK(sets.join(3, 1));
    CHECK(sets.take_numbers() == std::vector<std::uint32_t>{0, 1, 2, 1, 2, 1, 2});
    CHECK(DisjointSets(0).take_numbers().empty());
}

}  // namespace
}  // namespace rimline
