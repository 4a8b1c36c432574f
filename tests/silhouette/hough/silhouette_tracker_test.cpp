#include "silhouette/hough/silhouette_tracker.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numbers>
#include <thread>
#include <type_traits>
#include <vector>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/against_brute_force.h"
#include "tests/silhouette/hough/allocation_count.h"
#include "tests/silhouette/hough/shadow_consumer.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/random_walk.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

static_assert(!std::is_copy_constructible_v<SilhouetteTracker>);
static_assert(std::is_nothrow_move_constructible_v<SilhouetteTracker>);

TEST_CASE("every move of a random walk equals brute force on every made mesh") {
    const std::uint32_t moves = 500;
    for (const auto& [name, source] : tests::made_meshes(3000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        tests::check_walk(HoughOctree(mesh), moves, 31);
    }
}

TEST_CASE("moves are right from every origin and with several") {
    for (const auto& [name, source] : tests::made_meshes(600)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for (const std::vector<glm::dvec3>& origins : tests::origin_lists(mesh)) {
            CAPTURE(origins.size());
            CAPTURE(origins[0].x);
            tests::check_walk(HoughOctree(mesh, {origins}), 40, 32);
        }
    }
}

// A book: pages that meet at one edge, and all turn when the eye passes the plane in which they nearly lie.
MeshSource book(std::uint32_t pages) {
    MeshSource source{{{0, 0, 0}, {0, 0, 1}}, {}};
    for (std::uint32_t i = 0; i < pages; ++i) {
        source.positions.emplace_back(1.0f + float(i) * 1e-4f, 1e-6f * float(i % 997), 0.5f);
        source.triangles.push_back({0, 1, 2 + i});
    }
    // So rough that the tracker does not extract again.
    constexpr std::uint32_t k_side = 300;
    tests::Random random(34);
    const auto first = static_cast<std::uint32_t>(source.positions.size());
    for (std::uint32_t i = 0; i < k_side * k_side; ++i)
        source.positions.emplace_back(1000.0f + float(i / k_side), 10.0f * random.signed_unit(),
                                      float(i % k_side));
    for (std::uint32_t i = 0; i + k_side + 1 < k_side * k_side; ++i) {
        const std::uint32_t a = first + i;
        source.triangles.push_back({a, a + 1, a + k_side});
        source.triangles.push_back({a + 1, a + k_side + 1, a + k_side});
    }
    return source;
}

TEST_CASE("a book whose pages all turn has the changes of brute force") {
    const Mesh mesh(book(300));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({5, -0.1f, 0.5f}));
    for (const float y : {0.1f, 1e-4f, -0.1f, 3.0f, -3.0f}) {
        const HomogeneousPoint point = HomogeneousPoint::viewpoint({5, y, 0.5f});
        tracker.move_to(point);
        std::vector<EdgeId> edges(tracker.silhouette().begin(), tracker.silhouette().end());
        std::ranges::sort(edges);
        CHECK(edges == brute_force_silhouette(mesh, point));
    }
}

TEST_SUITE("plain") {
    TEST_CASE("a move takes no longer for many faces at one edge than an extraction and a bit") {
        const Mesh mesh(book(40'000));
        const HoughOctree octree(mesh);
        const std::array<HomogeneousPoint, 2> points{HomogeneousPoint::viewpoint({5, -0.1f, 0.5f}),
                                                     HomogeneousPoint::viewpoint({5, 0.1f, 0.5f})};
        SilhouetteTracker tracker(octree, points[0]);
        double least_ms = 1e9;
        for (int i = 1; i <= 4; ++i) {
            const auto start = std::chrono::steady_clock::now();
            const ChangeSet& changes = tracker.move_to(points[i % 2]);
            const std::chrono::duration<double, std::milli> time =
                std::chrono::steady_clock::now() - start;
            CHECK(changes.flipped.size() >= 40'000);
            CHECK_FALSE(tracker.was_extracted());
            least_ms = std::min(least_ms, time.count());
        }
        // 1 ms. It was 800 when each page looked at all others.
        CHECK(least_ms < 100.0);
    }
}

TEST_CASE("a move does not allocate") {
    for (const auto& [name, source] : tests::made_meshes(3000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const HoughOctree octree(mesh);
        tests::RandomWalk walk(mesh, 33);
        const std::uint64_t before_construction = tests::allocation_count();
        SilhouetteTracker tracker(octree, walk.point());
        CHECK(tests::allocation_count() > before_construction);  // The count counts.
        for (std::uint32_t i = 0; i < 200; ++i) {
            const HomogeneousPoint p = walk.next();
            const std::uint64_t before = tests::allocation_count();
            tracker.move_to(p);
            REQUIRE(tests::allocation_count() == before);
        }
    }
}

TEST_CASE("a move to where the tracker is changes nothing but the sequence") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const HoughOctree octree(mesh);
    const HomogeneousPoint p = HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f});
    SilhouetteTracker tracker(octree, p);
    CHECK(tracker.sequence() == 0);
    const ChangeSet& changes = tracker.move_to(p);
    CHECK(changes.sequence == 1);
    CHECK(changes.silhouette_size == tracker.silhouette().size());
    CHECK(changes.flipped.empty());
    CHECK(changes.slots.empty());
    CHECK(changes.words.empty());
    CHECK(changes.counters.box_checks == 0);
}

TEST_CASE("two trackers that see the same points hold the same slots") {
    const Mesh mesh(make_built_in_shape("spring", 3000));
    const HoughOctree octree(mesh);
    tests::RandomWalk walk(mesh, 34);
    SilhouetteTracker a(octree, walk.point());
    SilhouetteTracker b(octree, walk.point());
    for (std::uint32_t i = 0; i < 100; ++i) {
        const HomogeneousPoint p = walk.next();
        a.move_to(p);
        b.move_to(p);
        REQUIRE(std::ranges::equal(a.silhouette(), b.silhouette()));
    }
}

TEST_CASE("a tracker that was moved as an object goes on where it was") {
    const Mesh mesh(make_built_in_shape("torus", 2000));
    const HoughOctree octree(mesh);
    SilhouetteTracker first(octree, HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f}));
    tests::ShadowConsumer shadow(first);
    SilhouetteTracker second(std::move(first));
    shadow.follow(second, second.move_to(HomogeneousPoint::viewpoint({-3.0f, 1.0f, 1.0f})));
}

TEST_CASE("a small step along an orbit looks at a small part of a large mesh") {
    const Mesh mesh(make_built_in_shape("knot", 60000));
    const HoughOctree octree(mesh);
    const Orbit orbit(mesh.center(), {0.0, 1.0, 0.0}, 2.0 * mesh.radius());
    const double step_rad = 0.5 * std::numbers::pi / 180.0;
    SilhouetteTracker tracker(octree, orbit.viewpoint(0.0));
    tests::ShadowConsumer shadow(tracker);
    std::uint64_t face_checks = 0;
    std::uint64_t flips = 0;
    const std::uint32_t frames = 180;
    for (std::uint32_t i = 1; i <= frames; ++i) {
        const ChangeSet& changes = tracker.move_to(orbit.viewpoint(i * step_rad));
        face_checks += changes.counters.face_checks;
        flips += changes.flipped.size();
        shadow.follow(tracker, changes);
    }
    CHECK(flips > 10 * frames);
    CHECK(face_checks < std::uint64_t{frames} * mesh.face_count() / 5);
}

TEST_SUITE("threads") {
    TEST_CASE("many trackers share one octree across threads") {
        const Mesh mesh(make_built_in_shape("torus", 4000));
        const HoughOctree octree(mesh);
        std::vector<std::vector<EdgeId>> ends(4);
        std::vector<std::thread> threads;
        for (std::uint32_t t = 0; t < ends.size(); ++t)
            threads.emplace_back([&, t] {
                tests::RandomWalk walk(mesh, 35 + t);
                SilhouetteTracker tracker(octree, walk.point());
                for (std::uint32_t i = 0; i < 100; ++i) tracker.move_to(walk.next());
                ends[t] = tests::sorted(tracker.silhouette());
            });
        for (std::thread& thread : threads) thread.join();
        for (std::uint32_t t = 0; t < ends.size(); ++t) {
            tests::RandomWalk walk(mesh, 35 + t);
            for (std::uint32_t i = 0; i < 100; ++i) walk.next();
            CHECK(ends[t] == brute_force_silhouette(mesh, walk.point()));
        }
    }
}

}  // namespace
}  // namespace rimline
