// What the index answers, in which order and by how much work does not depend on the instruction set.

#include <doctest/doctest.h>

#include "silhouette/hough/silhouette_tracker.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/against_brute_force.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

TEST_CASE("extraction and moves equal brute force on every instruction set") {
    std::uint32_t sets = 0;
    tests::for_each_instruction_set([&](const std::string& set) {
        CAPTURE(set);
        ++sets;
        for (const auto& [name, source] : tests::made_meshes(700)) {
            CAPTURE(name);
            const Mesh mesh(source);
            const HoughOctree octree(mesh, {tests::origin_lists(mesh).back()});
            tests::check_extraction(octree, 60, 91);
            tests::check_walk(octree, 60, 92);
        }
    });
    MESSAGE(sets << " instruction sets");
    CHECK(sets >= 2);  // Scalar code is there on every machine.
}

struct Trace {
    std::vector<EdgeId> edges;
    std::vector<std::uint64_t> work;
    bool operator==(const Trace&) const = default;
};

Trace trace_of(const HoughOctree& octree) {
    Trace trace;
    const auto note = [&](const TraversalCounters& c) {
        trace.work.insert(trace.work.end(), {c.box_checks, c.face_checks, c.edge_checks});
    };
    tests::RandomWalk walk(octree.mesh(), 93);
    SilhouetteTracker tracker(octree, walk.point());
    std::vector<EdgeId> edges;
    for (std::uint32_t i = 0; i < tests::rounds(100u); ++i) {
        const ChangeSet& change = tracker.move_to(walk.next());
        note(change.counters);
        trace.edges.insert(trace.edges.end(), change.added.begin(), change.added.end());
        trace.edges.insert(trace.edges.end(), change.removed.begin(), change.removed.end());
        TraversalCounters counters;
        octree.extract(walk.point(), edges, counters);
        note(counters);
        trace.edges.insert(trace.edges.end(), edges.begin(), edges.end());
    }
    return trace;
}

TEST_CASE("order and work are the same on every instruction set") {
    for (const auto& [name, source] : tests::made_meshes(3000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const HoughOctree octree(mesh);
        const Trace best = trace_of(octree);
        tests::for_each_instruction_set([&](const std::string& set) {
            CAPTURE(set);
            REQUIRE(trace_of(octree) == best);
        });
    }
}

}  // namespace
}  // namespace rimline
