#include "silhouette/methods/packed_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace rimline {
namespace {

constexpr std::array<std::uint32_t, 12> k_sizes{0,   1,   15,  16,   17,   127,
                                                128, 129, 145, 1024, 1025, 20000};

std::vector<PackedKey> random_keys(std::uint32_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    std::vector<PackedKey> keys(count);
    for (PackedKey& key : keys)
        for (float& c : key) c = coordinate(random);
    return keys;
}

TEST_CASE("an order names every item once, whatever the keys are") {
    for (const std::uint32_t size : k_sizes) {
        CAPTURE(size);
        for (const std::vector<PackedKey>& keys :
             {random_keys(size, 1),
              std::vector<PackedKey>(size, PackedKey{1.0f, 2.0f, 3.0f, 4.0f})}) {
            std::vector<std::uint32_t> order = packed_order(keys);
            std::sort(order.begin(), order.end());
            std::vector<std::uint32_t> expected(size);
            std::iota(expected.begin(), expected.end(), 0u);
            CHECK(order == expected);
        }
    }
}

TEST_CASE("clusters that fill nodes become nodes") {
    // Eight clusters of 128 items, far apart: each is one node of level 1.
    std::vector<PackedKey> keys = random_keys(1024, 2);
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        const std::uint32_t cluster = i % 8;
        keys[i][0] += cluster & 1 ? 100.0f : 0.0f;
        keys[i][1] += cluster & 2 ? 50.0f : 0.0f;
        keys[i][3] += cluster & 4 ? 25.0f : 0.0f;
    }
    const std::vector<std::uint32_t> order = packed_order(keys);
    const PackedTree tree(1024);
    REQUIRE(tree.level_count() == 2);
    REQUIRE(tree.node_count(1) == 8);
    for (std::uint32_t node = 0; node < 8; ++node) {
        const PackedTree::Range range = tree.items_of(1, node);
        REQUIRE(range.size() == 128);
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            CHECK(order[i] % 8 == order[range.begin] % 8);
    }
}

TEST_CASE("a walk that enters everything visits every leaf once") {
    for (const std::uint32_t size : k_sizes) {
        CAPTURE(size);
        const PackedTree tree(size);
        std::vector<int> visits((size + k_leaf_items - 1) / k_leaf_items, 0);
        std::vector<int> entered(tree.group_count(), 0);
        tree.walk(
            [&](const PackedTree::Siblings& siblings) {
                ++entered[siblings.group];
                return siblings.lanes();
            },
            [&](std::uint32_t leaf) { ++visits[leaf]; });
        CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
        CHECK(std::all_of(entered.begin(), entered.end(), [](int n) { return n == 1; }));
    }
}

TEST_CASE("a walk enters the nodes of the mask and no others") {
    const PackedTree tree(20000);
    const std::uint32_t wanted = 777;  // A leaf.
    std::vector<std::uint32_t> visited;
    std::uint32_t groups = 0;
    tree.walk(
        [&](const PackedTree::Siblings& siblings) {
            ++groups;
            std::uint32_t mask = 0;
            for (std::uint32_t i = 0; i < siblings.count; ++i) {
                const PackedTree::Range range =
                    tree.items_of(siblings.level, siblings.first_node + i);
                const std::uint32_t item = wanted * k_leaf_items;
                if (range.begin <= item && item < range.end) mask |= 1u << i;
            }
            return mask;
        },
        [&](std::uint32_t leaf) { visited.push_back(leaf); });
    CHECK(visited == std::vector<std::uint32_t>{wanted});
    CHECK(groups == tree.level_count());
}

TEST_CASE("the items of nodes are those of their children") {
    for (const std::uint32_t size : k_sizes) {
        CAPTURE(size);
        const PackedTree tree(size);
        for (std::uint32_t level = 0; level < tree.level_count(); ++level) {
            std::uint32_t next = 0;
            for (std::uint32_t node = 0; node < tree.node_count(level); ++node) {
                const PackedTree::Range range = tree.items_of(level, node);
                CHECK(range.begin == next);
                CHECK(range.size() > 0);
                next = range.end;
                if (level == 0) continue;
                CHECK(tree.items_of(level - 1, node * k_fan_out).begin == range.begin);
            }
            CHECK(next == size);
        }
    }
}

}  // namespace
}  // namespace rimline
