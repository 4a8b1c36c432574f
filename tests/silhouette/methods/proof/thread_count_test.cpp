// The built index, its results, their order and the work do not depend on the number of threads that build
// the index, nor on the number of trackers that use it at the same time.

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <optional>
#include <thread>

#include "silhouette/hough/face_links.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/models.h"
#include "tests/silhouette/hough/shadow_consumer.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/hostile_walk.h"
#include "tests/skip.h"

namespace rimline {
namespace {

// All public data of an index, with its order.
struct Trace {
    std::vector<std::uint64_t> numbers;
    bool operator==(const Trace&) const = default;

    void add(std::uint64_t number) { numbers.push_back(number); }
    template <typename Id>
    void add_ids(std::span<const Id> ids) {
        add(ids.size());
        for (const Id id : ids) add(index(id));
    }
    void add(const TraversalCounters& c) {
        add(c.box_checks);
        add(c.face_checks);
        add(c.edge_checks);
    }
};

void add_index(const HoughOctree& octree, Trace& trace) {
    const HoughOctreeStatistics& s = octree.statistics();
    for (const std::uint64_t n :
         {std::uint64_t{s.nodes}, std::uint64_t{s.depth}, std::uint64_t{s.faces},
          std::uint64_t{s.owned_edges}, std::uint64_t{s.ghost_edges}, std::uint64_t{s.sfo_edges},
          std::uint64_t{s.undecided_edges}, std::uint64_t{s.nonmanifold_edges}, s.size_bytes})
        trace.add(n);
    for (const std::uint32_t group : octree.face_groups()) trace.add(group);
    for (std::uint32_t i = 0; i < octree.block_count() * k_block_size; ++i) {
        trace.add(index(octree.face_at(i)));
        for (const std::uint32_t place : octree.links()[i].places) trace.add(place);
        for (const std::uint32_t edge : octree.links()[i].edges) trace.add(edge);
    }
}

void add_walk(const HoughOctree& octree, std::uint32_t moves, std::uint64_t seed, Trace& trace) {
    tests::HostileWalk walk(octree.mesh(), seed);
    SilhouetteTracker tracker(octree, walk.point());
    BlockScratch scratch = octree.make_scratch();
    std::vector<EdgeId> edges;
    for (std::uint32_t i = 0; i < moves; ++i) {
        const ChangeSet& changes = tracker.move_to(walk.next());
        trace.add_ids(changes.flipped);
        trace.add_ids(changes.added);
        trace.add_ids(changes.removed);
        for (const SlotWrite& write : changes.slots) {
            trace.add(write.slot);
            trace.add(index(write.edge));
        }
        trace.add(changes.counters);
        TraversalCounters counters;
        octree.extract(walk.point(), edges, counters, scratch);
        trace.add_ids(std::span<const EdgeId>(edges));
        trace.add(counters);
    }
}

// The data of an index built by `threads` threads. Some numbers exceed the number of cores.
Trace trace_of(const Mesh& mesh, const HoughOctreeOptions& options, int threads,
               std::uint32_t moves, std::uint64_t seed) {
    const auto most = static_cast<std::size_t>(threads);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, most);
    tbb::task_arena arena(threads);
    Trace trace;
    arena.execute([&] {
        const HoughOctree octree(mesh, options);
        add_index(octree, trace);
        add_walk(octree, moves, seed, trace);
    });
    return trace;
}

void prove_builds(const Mesh& mesh, std::uint32_t moves, std::uint64_t seed) {
    const glm::dvec3 c = mesh.center();
    const double r = mesh.radius();
    for (const std::vector<glm::dvec3>& origins :
         {std::vector<glm::dvec3>{},
          std::vector<glm::dvec3>{c, c + glm::dvec3(0.7 * r, -r, 0.1)}}) {
        CAPTURE(origins.size());
        const Trace expected = trace_of(mesh, {origins}, 1, moves, seed);
        for (const int threads : {2, 3, 8}) {
            CAPTURE(threads);
            // Not REQUIRE(a == b): it would print millions of numbers.
            const bool is_same = trace_of(mesh, {origins}, threads, moves, seed) == expected;
            REQUIRE(is_same);
        }
    }
}

// Each thread has its own points, checked alone first.
void prove_trackers(const Mesh& mesh, std::uint32_t moves, std::uint64_t seed) {
    constexpr std::size_t k_threads = 4;
    const HoughOctree octree(mesh);
    std::array<Trace, k_threads> expected;
    std::array<Trace, k_threads> found;
    for (std::size_t t = 0; t < k_threads; ++t) {
        add_walk(octree, moves, seed + t, expected[t]);
        tests::HostileWalk walk(mesh, seed + t);
        SilhouetteTracker tracker(octree, walk.point());
        tests::ShadowConsumer consumer(tracker);
        for (std::uint32_t i = 0; i < moves; ++i)
            consumer.follow(tracker, tracker.move_to(walk.next()));
    }
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < k_threads; ++t)
            threads.emplace_back([&, t] { add_walk(octree, moves, seed + t, found[t]); });
    }
    const bool is_same = found == expected;
    REQUIRE(is_same);
    REQUIRE_FALSE(expected[0] == expected[1]);
}

TEST_CASE("an index is the same whatever the number of threads that build it") {
    for (const char* shape : {"spring", "scene"}) {
        CAPTURE(shape);
        prove_builds(Mesh(make_built_in_shape(shape, 20'000)), 20, 501);
    }
    prove_builds(Mesh(tests::triangle_soup(5000, 502)), 20, 503);
}

TEST_SUITE("threads") {
    TEST_CASE("trackers on several threads find what each finds alone") {
        prove_trackers(Mesh(make_built_in_shape("knot", 4000)), 100, 504);
        prove_trackers(Mesh(tests::triangle_soup(1000, 505)), 100, 506);
    }
}

TEST_SUITE("long") {
    TEST_CASE("indices and trackers of models are the same whatever the number of threads") {
        const std::uint64_t seed = 507;
        std::string missing;
        std::uint32_t models = 0;
        for (const char* file :
             {"alligator.obj", "beetle-alt.obj", "fandisk.obj", "horse.ply", "igea.ply",
              "nefertiti.obj", "ogre.obj", "rocker-arm.obj", "stanford-bunny.obj"}) {
            const auto path = tests::find_model(file);
            if (!path) {
                missing.append(" ").append(file);
                continue;
            }
            CAPTURE(file);
            const Mesh mesh(read_mesh_file(*path));
            prove_builds(mesh, 20, seed);
            prove_trackers(mesh, 30, seed);
            ++models;
        }
        MESSAGE(models << " models, seed " << seed
                       << ": 8 builds of 1, 2, 3 and 8 threads, 4 trackers at once");
        if (!missing.empty()) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds" + missing);
    }
}

}  // namespace
}  // namespace rimline
