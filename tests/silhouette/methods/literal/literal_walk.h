#pragma once

// A random walk that compares the state of a LiteralTracker with brute force after each move.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/literal/literal_tracker.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline::tests {

inline void check_literal_state(const LiteralTracker& tracker, const Mesh& mesh) {
    const std::vector<std::uint32_t> words(tracker.face_words().begin(),
                                           tracker.face_words().end());
    REQUIRE(words == brute_force_face_bits(mesh, tracker.point()));
    std::vector<EdgeId> edges(tracker.silhouette().begin(), tracker.silhouette().end());
    std::sort(edges.begin(), edges.end());
    REQUIRE(edges == brute_force_silhouette(mesh, tracker.point()));
}

inline void check_literal_walk(const LiteralOctree& octree, const LiteralTrackerOptions& options,
                               std::uint32_t moves, std::uint64_t seed) {
    CAPTURE(seed);
    CAPTURE(static_cast<int>(options.update));
    RandomWalk walk(octree.mesh(), seed);
    LiteralTracker tracker(octree, walk.point(), options);
    check_literal_state(tracker, octree.mesh());
    for (std::uint32_t i = 0; i < rounds(moves); ++i) {
        const HomogeneousPoint p = walk.next();
        CAPTURE(i);
        CAPTURE(p.x);
        CAPTURE(p.y);
        CAPTURE(p.z);
        CAPTURE(p.w);
        tracker.move_to(p);
        check_literal_state(tracker, octree.mesh());
    }
}

}  // namespace rimline::tests
