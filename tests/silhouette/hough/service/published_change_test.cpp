#include "silhouette/hough/service/published_change.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/service/allocation_faults.h"

namespace rimline {
namespace {

bool is_equal(const ChangeSet& a, const ChangeSet& b) {
    return a.point == b.point && a.sequence == b.sequence &&
           a.silhouette_size == b.silhouette_size && std::ranges::equal(a.flipped, b.flipped) &&
           std::ranges::equal(a.added, b.added) && std::ranges::equal(a.removed, b.removed) &&
           std::ranges::equal(a.slots, b.slots) && std::ranges::equal(a.words, b.words) &&
           a.counters.box_checks == b.counters.box_checks &&
           a.counters.face_checks == b.counters.face_checks &&
           a.counters.edge_checks == b.counters.edge_checks;
}

TEST_CASE("a published change set stays what it was when the tracker moves on") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f}));
    const ChangeSet& changes = tracker.move_to(HomogeneousPoint::viewpoint({2.0f, 2.5f, 1.0f}));
    REQUIRE(!changes.flipped.empty());
    REQUIRE(!changes.added.empty());
    REQUIRE(!changes.removed.empty());
    const auto posted = PublishedChange::Clock::now();
    PublishedChange copy;
    copy.assign(changes, posted);
    copy.stamp();
    CHECK(copy.posted() == posted);
    CHECK(copy.published() >= posted);
    CHECK(is_equal(copy.view(), changes));

    // The same move again, by another tracker, is what the first one's spans showed.
    tracker.move_to(HomogeneousPoint::viewpoint({-3.0f, 0.5f, -1.0f}));
    SilhouetteTracker again(octree, HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f}));
    const ChangeSet& same = again.move_to(HomogeneousPoint::viewpoint({2.0f, 2.5f, 1.0f}));
    CHECK(is_equal(copy.view(), same));
    const PublishedChange moved = std::move(copy);
    CHECK(is_equal(moved.view(), same));
}

TEST_CASE("a change set no larger than one before is copied without allocating") {
    const Mesh mesh(make_built_in_shape("torus", 3000));
    const HoughOctree octree(mesh);
    const std::array points{HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f}),
                            HomogeneousPoint::viewpoint({-3.0f, 1.0f, 2.0f})};
    SilhouetteTracker tracker(octree, points[0]);
    PublishedChange copy;
    SilhouetteSnapshot snapshot;
    // There and back: two change sets of about one size, twice.
    std::uint64_t before = tests::allocation_count();
    for (std::size_t i = 1; i <= 6; ++i) {
        if (i == 3) {
            CHECK(tests::allocation_count() > before);
            before = tests::allocation_count();
        }
        copy.assign(tracker.move_to(points[i % 2]), {});
        snapshot.assign(tracker);
    }
    CHECK(tests::allocation_count() == before);
    CHECK(copy.view().sequence == 6);
    CHECK(snapshot.sequence == 6);
    CHECK(snapshot.point == points[0]);
    CHECK(std::ranges::equal(snapshot.slots, tracker.silhouette()));
    CHECK(std::ranges::equal(snapshot.words, tracker.face_words()));
}

}  // namespace
}  // namespace rimline
