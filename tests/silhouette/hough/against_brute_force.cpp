#include "tests/silhouette/hough/against_brute_force.h"

#include <doctest/doctest.h>

#include "tests/rounds.h"
#include "tests/silhouette/hough/shadow_consumer.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline::tests {

void check_extraction(const HoughOctree& octree, std::uint32_t points, std::uint64_t seed) {
    CAPTURE(seed);
    ProbePoints probes(octree.mesh(), seed);
    for (std::uint32_t i = 0; i < rounds(points); ++i) {
        const HomogeneousPoint p = probes.next();
        CAPTURE(i);
        CAPTURE(p.x);
        CAPTURE(p.y);
        CAPTURE(p.z);
        CAPTURE(p.w);
        std::vector<EdgeId> edges{k_no_edge};  // Replaced, not appended to.
        TraversalCounters counters;
        octree.extract(p, edges, counters);
        REQUIRE(sorted(std::span<const EdgeId>(edges)) == brute_force_silhouette(octree.mesh(), p));
    }
}

void check_walk(const HoughOctree& octree, std::uint32_t moves, std::uint64_t seed) {
    CAPTURE(seed);
    RandomWalk walk(octree.mesh(), seed);
    SilhouetteTracker tracker(octree, walk.point());
    REQUIRE(sorted(tracker.silhouette()) == brute_force_silhouette(octree.mesh(), walk.point()));
    ShadowConsumer shadow(tracker);
    for (std::uint32_t i = 0; i < rounds(moves); ++i) {
        const HomogeneousPoint from = tracker.point();
        const HomogeneousPoint p = walk.next();
        CAPTURE(i);
        CAPTURE(p.x);
        CAPTURE(p.y);
        CAPTURE(p.z);
        CAPTURE(p.w);
        const ChangeSet& changes = tracker.move_to(p);
        shadow.follow(tracker, changes);
        if (p == from) REQUIRE(changes.flipped.empty());
    }
}

}  // namespace rimline::tests
