#include "silhouette/methods/brute_force_tracker.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/allocation_count.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

static_assert(!std::is_copy_constructible_v<BruteForceTracker>);
static_assert(std::is_nothrow_move_constructible_v<BruteForceTracker>);

template <typename Id>
std::vector<Id> sorted(std::span<const Id> ids) {
    std::vector<Id> result(ids.begin(), ids.end());
    std::sort(result.begin(), result.end());
    return result;
}

// Follows a tracker by its writes alone.
struct Consumer {
    std::vector<EdgeId> slots;
    std::vector<std::uint32_t> words;

    void apply(const ChangeSet& changes) {
        slots.resize(changes.silhouette_size, k_no_edge);
        for (const SlotWrite& write : changes.slots) slots.at(write.slot) = write.edge;
        for (const WordWrite& write : changes.words) words.at(write.word) = write.bits;
    }
};

void check_against_indexed_tracker(const Mesh& mesh, std::uint32_t moves, std::uint64_t seed) {
    CAPTURE(seed);
    tests::RandomWalk walk(mesh, seed);
    const HoughOctree octree(mesh);
    SilhouetteTracker indexed(octree, walk.point());
    BruteForceTracker tracker(mesh, walk.point());
    Consumer consumer{{tracker.silhouette().begin(), tracker.silhouette().end()},
                      {tracker.face_words().begin(), tracker.face_words().end()}};
    REQUIRE(sorted(tracker.silhouette()) == brute_force_silhouette(mesh, walk.point()));
    for (std::uint32_t i = 0; i < moves; ++i) {
        CAPTURE(i);
        const HomogeneousPoint p = walk.next();
        const ChangeSet& expected = indexed.move_to(p);
        const ChangeSet& changes = tracker.move_to(p);
        REQUIRE(sorted(tracker.silhouette()) == brute_force_silhouette(mesh, p));
        REQUIRE(std::ranges::equal(tracker.face_words(), brute_force_face_bits(mesh, p)));
        REQUIRE(changes.point == p);
        REQUIRE(changes.sequence == i + 1);
        REQUIRE(changes.silhouette_size == expected.silhouette_size);
        REQUIRE(sorted(changes.flipped) == sorted(expected.flipped));
        REQUIRE(sorted(changes.added) == sorted(expected.added));
        REQUIRE(sorted(changes.removed) == sorted(expected.removed));
        REQUIRE(changes.words.size() == expected.words.size());
        REQUIRE(changes.slots.size() <= changes.added.size() + changes.removed.size());
        consumer.apply(changes);
        REQUIRE(std::ranges::equal(consumer.slots, tracker.silhouette()));
        REQUIRE(std::ranges::equal(consumer.words, tracker.face_words()));
    }
}

TEST_CASE("brute force that follows a point writes the change sets of the indexed tracker") {
    for (const auto& [name, source] : tests::made_meshes(1500)) {
        CAPTURE(name);
        check_against_indexed_tracker(Mesh(source), 200, 51);
    }
}

TEST_CASE("brute force finds the silhouette afresh when most faces flip, and only then") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    BruteForceTracker tracker(mesh, HomogeneousPoint::direction({0.3f, 0.2f, 1.0f}));
    CHECK(tracker.move_to(HomogeneousPoint::direction({-0.3f, -0.2f, -1.0f})).flipped.size() >
          mesh.face_count() * 9 / 10);
    CHECK(tracker.was_extracted());
    tracker.move_to(HomogeneousPoint::direction({-0.3f, -0.21f, -1.0f}));
    CHECK_FALSE(tracker.was_extracted());
}

TEST_CASE("brute force that follows a point counts every face and the edges it looks at") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    BruteForceTracker tracker(mesh, HomogeneousPoint::viewpoint({4.0f, 1.0f, 2.0f}));
    const ChangeSet& changes = tracker.move_to(HomogeneousPoint::viewpoint({4.0f, 1.1f, 2.0f}));
    CHECK(changes.flipped.size() > 0);
    CHECK(changes.counters.box_checks == 0);
    CHECK(changes.counters.face_checks == mesh.face_count());
    CHECK(changes.counters.edge_checks == 3 * changes.flipped.size());
}

TEST_CASE("a move of brute force that follows a point does not allocate") {
    for (const auto& [name, source] : tests::made_meshes(1500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        tests::RandomWalk walk(mesh, 52);
        const std::uint64_t before_construction = tests::allocation_count();
        BruteForceTracker tracker(mesh, walk.point());
        CHECK(tests::allocation_count() > before_construction);  // The counter works.
        for (std::uint32_t i = 0; i < 100; ++i) {
            const HomogeneousPoint p = walk.next();
            const std::uint64_t before = tests::allocation_count();
            tracker.move_to(p);
            REQUIRE(tests::allocation_count() == before);
        }
    }
}

}  // namespace
}  // namespace rimline
