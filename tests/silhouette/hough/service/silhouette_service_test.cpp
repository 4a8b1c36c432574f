#include "silhouette/hough/service/silhouette_service.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "silhouette/hough/orbit.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tests/silhouette/hough/service/allocation_faults.h"
#include "tests/silhouette/hough/service/follower.h"
#include "tests/silhouette/hough/service/indexed_shape.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

static_assert(!std::is_copy_constructible_v<SilhouetteService>);

// Different silhouettes, none near another.
HomogeneousPoint place(std::uint32_t i) {
    return Orbit(glm::dvec3(0.0), {0.2, 1.0, 0.1}, 3.0 + 0.1 * (i % 7)).viewpoint(0.7 * i);
}

// What one consumer thread found wrong, and how far it came.
struct Consumed {
    std::string problem;
    std::uint64_t changes = 0;
    HomogeneousPoint point{};
};

// Follows a tracker by its change sets until `last` is reached, and expects the points of `posted`, each
// once at most and in their order.
Consumed consume(SilhouetteService& service, TrackerId id, const Mesh& mesh,
                 const std::vector<HomogeneousPoint>& posted) {
    Consumed result;
    tests::Follower follower(mesh);
    SilhouetteSnapshot start;
    if (!service.snapshot(id, start)) return {"no snapshot"};
    if (const auto problem = follower.begin(start)) return {*problem};
    PublishedChange change;
    auto next = posted.begin();
    while (next != posted.end() && service.wait_for_change(id)) {
        if (service.take(id, change) != Taken::change) return {"nothing to take after a wait"};
        if (const auto problem = follower.follow(change.view())) return {*problem};
        next = std::find(next, posted.end(), follower.point());
        if (next == posted.end()) return {"a point that was not posted after the last one"};
        ++next;
        ++result.changes;
    }
    result.point = follower.point();
    return result;
}

TEST_CASE("every tracker's change sets come in order, without a gap, and equal brute force") {
    const std::vector<std::unique_ptr<tests::IndexedShape>> models = [] {
        std::vector<std::unique_ptr<tests::IndexedShape>> made;
        for (const char* shape : {"knot", "torus", "terrain"})
            made.push_back(std::make_unique<tests::IndexedShape>(shape, 1500));
        return made;
    }();
    for (const std::uint32_t workers : {1u, 3u}) {
        CAPTURE(workers);
        SilhouetteService service({.workers = workers, .max_pending = 2});
        const std::uint32_t count = 6;
        const std::uint32_t points = 120;
        std::vector<TrackerId> ids;
        std::vector<std::vector<HomogeneousPoint>> posted(count);
        for (std::uint32_t t = 0; t < count; ++t) {
            const tests::IndexedShape& model = *models[t % models.size()];
            tests::RandomWalk walk(model.mesh, 41 + t);
            ids.push_back(service.add(model.octree, walk.point()));
            for (std::uint32_t i = 0; i + 1 < points; ++i) posted[t].push_back(walk.next());
            // A last point that is no other, so that reaching it means something.
            posted[t].push_back(HomogeneousPoint::viewpoint({9.5f, 8.5f, 7.5f}));
        }
        std::vector<Consumed> consumed(count);
        std::vector<std::thread> consumers;
        for (std::uint32_t t = 0; t < count; ++t)
            consumers.emplace_back([&, t] {
                consumed[t] = consume(service, ids[t], models[t % models.size()]->mesh, posted[t]);
            });
        for (std::uint32_t i = 0; i < points; ++i) {
            for (std::uint32_t t = 0; t < count; ++t) REQUIRE(service.post(ids[t], posted[t][i]));
            // Sometimes workers keep up, sometimes points are superseded.
            if (i % 3 == 0) service.wait_idle();
        }
        for (std::thread& consumer : consumers) consumer.join();
        std::uint64_t changes = 0;
        for (std::uint32_t t = 0; t < count; ++t) {
            CAPTURE(t);
            CHECK(consumed[t].problem == "");
            CHECK(consumed[t].point == posted[t].back());
            changes += consumed[t].changes;
        }
        const SilhouetteServiceCounters counters = service.counters();
        CHECK(counters.posts == count * points);
        CHECK(counters.moves + counters.superseded == counters.posts);
        CHECK(counters.moves >= changes);
        CHECK(counters.lost == 0);
    }
}

TEST_CASE("only the latest of the points posted meanwhile is moved to") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 2, .max_pending = 1});
    const TrackerId id = service.add(model.octree, place(0));
    service.post(id, place(1));
    service.wait_idle();
    // The one place is taken: the tracker stays.
    for (std::uint32_t i = 2; i <= 10; ++i) service.post(id, place(i));
    service.wait_idle();
    CHECK(service.counters().moves == 1);
    PublishedChange change;
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(change.view().point == place(1));
    REQUIRE(service.wait_for_change(id));
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(change.view().point == place(10));
    CHECK(change.view().sequence == 2);
    service.wait_idle();
    CHECK(service.take(id, change) == Taken::nothing);
    CHECK(service.counters().moves == 2);
    CHECK(service.counters().superseded == 8);
}

TEST_CASE("a consumer that falls behind finds the oldest change sets and then one large one") {
    const tests::IndexedShape model("knot", 1000);
    SilhouetteService service({.workers = 1, .max_pending = 3});
    const TrackerId id = service.add(model.octree, place(0));
    tests::Follower follower(model.mesh);
    SilhouetteSnapshot start;
    REQUIRE(service.snapshot(id, start));
    CHECK(start.sequence == 0);
    REQUIRE(follower.begin(start) == std::nullopt);
    for (std::uint32_t i = 1; i <= 9; ++i) {
        service.post(id, place(i));
        service.wait_idle();
    }
    CHECK(service.counters().moves == 3);
    PublishedChange change;
    for (const std::uint32_t expected : {1u, 2u, 3u, 9u}) {
        CAPTURE(expected);
        REQUIRE(service.wait_for_change(id));
        REQUIRE(service.take(id, change) == Taken::change);
        CHECK(follower.follow(change.view()) == std::nullopt);
        CHECK(follower.point() == place(expected));
    }
    CHECK(service.take(id, change) == Taken::nothing);
}

TEST_CASE("a snapshot drops what is pending, makes room and is what the next change set follows") {
    const tests::IndexedShape model("spring", 1000);
    SilhouetteService service({.workers = 1, .max_pending = 3});
    const TrackerId id = service.add(model.octree, place(0));
    for (std::uint32_t i = 1; i <= 9; ++i) {
        service.post(id, place(i));
        service.wait_idle();
    }
    tests::Follower follower(model.mesh);
    SilhouetteSnapshot snapshot;
    REQUIRE(service.snapshot(id, snapshot));
    CHECK(snapshot.sequence == 3);
    CHECK(snapshot.point == place(3));
    CHECK(follower.begin(snapshot) == std::nullopt);
    PublishedChange change;
    REQUIRE(service.wait_for_change(id));
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(follower.follow(change.view()) == std::nullopt);
    CHECK(follower.point() == place(9));
    CHECK(service.take(id, change) == Taken::nothing);
}

TEST_CASE("memory that runs out makes a gap that is told and that a snapshot closes") {
    const tests::IndexedShape model("knot", 1000);
    SilhouetteService service({.workers = 1});
    const TrackerId id = service.add(model.octree, place(0));
    {
        const tests::AllocationFaults out_of_memory;
        service.post(id, place(1));
        service.wait_idle();
    }
    CHECK(service.counters().lost == 1);
    PublishedChange change;
    CHECK(service.wait_for_change(id));
    CHECK(service.take(id, change) == Taken::gap);
    tests::Follower follower(model.mesh);
    SilhouetteSnapshot snapshot;
    {
        const tests::AllocationFaults out_of_memory;
        CHECK_THROWS_AS(service.snapshot(id, snapshot), std::bad_alloc);
    }
    CHECK(service.take(id, change) == Taken::gap);
    REQUIRE(service.snapshot(id, snapshot));
    CHECK(follower.begin(snapshot) == std::nullopt);
    CHECK(follower.point() == place(1));
    CHECK(service.take(id, change) == Taken::nothing);
    service.post(id, place(2));
    REQUIRE(service.wait_for_change(id));
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(follower.follow(change.view()) == std::nullopt);
}

TEST_CASE("a service that finds no memory for its workers ends those it has and says so") {
    for (std::uint64_t spared = 0;; ++spared) {
        CAPTURE(spared);
        REQUIRE(spared < 100);
        try {
            const tests::AllocationFaults out_of_memory(spared);
            const SilhouetteService service({.workers = 4});
            break;
        } catch (const std::bad_alloc&) {
            // With one more perhaps.
        }
    }
}

TEST_CASE("what a tracker's making throws reaches who adds it, and the service goes on") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 1});
    {
        const tests::AllocationFaults out_of_memory;
        CHECK_THROWS_AS(service.add(model.octree, place(0)), std::bad_alloc);
    }
    const TrackerId id = service.add(model.octree, place(0));
    CHECK(service.post(id, place(1)));
    CHECK(service.wait_for_change(id));
}

TEST_CASE("posting where the tracker is publishes a change set that changes nothing") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service;
    CHECK(service.worker_count() >= 1);
    const TrackerId id = service.add(model.octree, place(0));
    service.post(id, place(0));
    REQUIRE(service.wait_for_change(id));
    PublishedChange change;
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(change.view().sequence == 1);
    CHECK(change.view().slots.empty());
    CHECK(change.view().words.empty());
    CHECK(change.published() >= change.posted());
}

TEST_CASE("frame after frame nothing is allocated on any thread") {
    const tests::IndexedShape model("knot", 2000);
    SilhouetteService service({.workers = 2, .max_pending = 2});
    std::vector<TrackerId> ids;
    for (std::uint32_t t = 0; t < 4; ++t) ids.push_back(service.add(model.octree, place(t)));
    const Orbit orbit(model.mesh.center(), {0.0, 1.0, 0.0}, 3.0);
    const std::uint32_t frames_a_turn = 24;
    const auto turn = [&](std::vector<PublishedChange>& changes) {
        for (std::uint32_t i = 0; i < frames_a_turn; ++i) {
            const auto p = orbit.viewpoint(2.0 * std::numbers::pi * i / frames_a_turn);
            for (const TrackerId id : ids) service.post(id, p);
            service.wait_idle();
            for (std::size_t t = 0; t < ids.size(); ++t)
                if (service.take(ids[t], changes[t]) != Taken::change) return false;
        }
        return true;
    };
    std::vector<PublishedChange> changes(ids.size());
    const std::uint64_t before = tests::allocation_count();
    for (int i = 0; i < 6; ++i) REQUIRE(turn(changes));
    const std::uint64_t warm = tests::allocation_count();
    CHECK(warm > before);
    REQUIRE(turn(changes));
    CHECK(tests::allocation_count() == warm);
    CHECK(changes[0].view().sequence == 7 * frames_a_turn);
}

TEST_CASE("a removed tracker's id is refused, also when another tracker has its place") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 1});
    const TrackerId old_id = service.add(model.octree, place(0));
    service.post(old_id, place(1));
    service.wait_idle();
    CHECK(service.remove(old_id));
    PublishedChange change;
    SilhouetteSnapshot snapshot;
    TrackerId new_id{};
    for (const bool has_other : {false, true}) {
        CAPTURE(has_other);
        if (has_other) {
            new_id = service.add(model.octree, place(2));
            CHECK(new_id != old_id);
        }
        CHECK(!service.remove(old_id));
        CHECK(!service.post(old_id, place(3)));
        CHECK(service.take(old_id, change) == Taken::removed);
        CHECK(!service.snapshot(old_id, snapshot));
        CHECK(!service.wait_for_change(old_id));
    }
    service.wait_idle();
    CHECK(service.take(new_id, change) == Taken::nothing);
    REQUIRE(service.snapshot(new_id, snapshot));
    CHECK(snapshot.point == place(2));
    CHECK(snapshot.sequence == 0);
}

TEST_CASE(
    "what a tracker has reserved is told, moves do not change it, and it stays within bounds") {
    const tests::IndexedShape model("knot", 20'000);
    SilhouetteService service({.workers = 1});
    const TrackerId id = service.add(model.octree, place(0));
    const std::uint64_t reserved = service.size_bytes(id);
    CHECK(reserved == SilhouetteTracker(model.octree, place(1)).size_bytes());
    CHECK(reserved <= 40u * model.mesh.edge_count() + 20u * model.mesh.face_count());
    for (std::uint32_t i = 1; i < 5; ++i) {
        service.post(id, place(i));
        CHECK(service.size_bytes(id) == reserved);
    }
    service.wait_idle();
    CHECK(service.size_bytes(id) == reserved);
    service.remove(id);
    CHECK(service.size_bytes(id) == 0);
}

TEST_CASE("a new tracker does not go where its predecessor was sent last") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 1, .max_pending = 1});
    const TrackerId first = service.add(model.octree, place(0));
    service.post(first, place(1));
    service.wait_idle();
    service.post(first, place(2));  // Held up, as the one place is taken.
    service.wait_idle();
    service.remove(first);
    const TrackerId second = service.add(model.octree, place(3));
    service.wait_idle();
    CHECK(service.counters().moves == 1);
    service.post(second, place(4));
    PublishedChange change;
    REQUIRE(service.wait_for_change(second));
    REQUIRE(service.take(second, change) == Taken::change);
    CHECK(change.view().sequence == 1);
    CHECK(change.view().point == place(4));
}

TEST_CASE("an octree may go as soon as its tracker is removed, whatever was posted") {
    SilhouetteService service({.workers = 2});
    for (std::uint32_t i = 0; i < 60; ++i) {
        const auto model = std::make_unique<tests::IndexedShape>("knot", 600);
        const TrackerId id = service.add(model->octree, place(i));
        for (std::uint32_t k = 1; k < i % 4 + 2; ++k) service.post(id, place(i + k));
        if (i % 3 == 0) std::this_thread::yield();
        REQUIRE(service.remove(id));
    }
}

TEST_CASE("hundreds of trackers all reach their points") {
    const tests::IndexedShape model("box", 100);
    SilhouetteService service({.workers = 2});
    std::vector<TrackerId> ids;
    for (std::uint32_t t = 0; t < 300; ++t) ids.push_back(service.add(model.octree, place(0)));
    CHECK(std::set<TrackerId>(ids.begin(), ids.end()).size() == ids.size());
    for (std::uint32_t t = 0; t < ids.size(); ++t) service.post(ids[t], place(t + 1));
    PublishedChange change;
    for (std::uint32_t t = 0; t < ids.size(); ++t) {
        REQUIRE(service.wait_for_change(ids[t]));
        REQUIRE(service.take(ids[t], change) == Taken::change);
        REQUIRE(change.view().point == place(t + 1));
    }
}

TEST_CASE("a service is full at 16,384 trackers and has room again when one goes") {
    const tests::IndexedShape model("box", 12);
    SilhouetteService service({.workers = 1, .max_pending = 1});
    std::vector<TrackerId> ids;
    for (std::uint32_t t = 0; t < 16'384; ++t) ids.push_back(service.add(model.octree, place(0)));
    bool is_refused = false;
    try {
        service.add(model.octree, place(0));
    } catch (const Error& error) {
        is_refused = error.code() == ErrorCode::too_large;
    }
    CHECK(is_refused);
    CHECK(service.post(ids.back(), place(1)));
    CHECK(service.wait_for_change(ids.back()));
    CHECK(service.remove(ids[100]));
    const TrackerId id = service.add(model.octree, place(0));
    CHECK(id != ids[100]);
    CHECK(service.post(id, place(1)));
    CHECK(service.wait_for_change(id));
}

TEST_CASE("a tracker that always has a new point holds up no other") {
    const tests::IndexedShape model("knot", 2000);
    SilhouetteService service({.workers = 1, .max_pending = 2});
    const TrackerId greedy = service.add(model.octree, place(0));
    std::vector<TrackerId> ids;
    for (std::uint32_t t = 0; t < 32; ++t) ids.push_back(service.add(model.octree, place(t)));
    std::atomic<bool> is_over{false};
    std::thread poster([&] {
        PublishedChange change;
        for (std::uint32_t i = 1; !is_over; ++i) {
            service.post(greedy, place(i));
            service.take(greedy, change);
        }
    });
    PublishedChange change;
    for (std::uint32_t round = 1; round <= 10; ++round) {
        for (std::uint32_t t = 0; t < ids.size(); ++t) service.post(ids[t], place(t + round));
        for (std::uint32_t t = 0; t < ids.size(); ++t) {
            REQUIRE(service.wait_for_change(ids[t]));
            REQUIRE(service.take(ids[t], change) == Taken::change);
            REQUIRE(change.view().point == place(t + round));
        }
    }
    is_over = true;
    poster.join();
}

TEST_CASE("after a stop nothing is accepted, and what was published can be taken") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 2});
    const TrackerId id = service.add(model.octree, place(0));
    service.post(id, place(1));
    service.wait_idle();
    service.stop();
    service.stop();
    CHECK(!service.post(id, place(2)));
    bool is_refused = false;
    try {
        service.add(model.octree, place(0));
    } catch (const Error& error) {
        is_refused = error.code() == ErrorCode::cancelled;
    }
    CHECK(is_refused);
    service.wait_idle();
    CHECK(service.wait_for_change(id));
    PublishedChange change;
    REQUIRE(service.take(id, change) == Taken::change);
    CHECK(change.view().point == place(1));
    CHECK(!service.wait_for_change(id));
    SilhouetteSnapshot snapshot;
    CHECK(service.snapshot(id, snapshot));
    CHECK(snapshot.point == place(1));
    CHECK(service.remove(id));
}

TEST_CASE("a wait ends when the service stops and when the tracker is removed") {
    const tests::IndexedShape model("torus", 1000);
    SilhouetteService service({.workers = 1});
    const TrackerId removed = service.add(model.octree, place(0));
    const TrackerId kept = service.add(model.octree, place(0));
    std::atomic<int> ended{0};
    std::thread first([&] { ended += !service.wait_for_change(removed); });
    service.remove(removed);
    first.join();
    CHECK(ended == 1);
    std::thread second([&] { ended += !service.wait_for_change(kept); });
    service.stop();
    second.join();
    CHECK(ended == 2);
}

TEST_CASE("a service may be destroyed with work pending and trackers left") {
    const tests::IndexedShape model("knot", 1000);
    for (std::uint32_t i = 0; i < 30; ++i) {
        SilhouetteService service({.workers = 1 + i % 3});
        std::vector<TrackerId> ids;
        for (std::uint32_t t = 0; t < 12; ++t) ids.push_back(service.add(model.octree, place(t)));
        for (std::uint32_t t = 0; t < ids.size(); ++t) service.post(ids[t], place(t + i));
        if (i % 2 == 0) std::this_thread::yield();
        CHECK(ids.size() == 12);  // And that it ends, within the time limit of the test.
    }
    const SilhouetteService unused;  // Neither need it ever have had any.
}

TEST_SUITE("plain") {
    TEST_CASE("a service has as many workers as memory has stacks for") {
        const tests::IndexedShape model("knot", 200);
        const pid_t child = fork();
        if (child == 0) {
            // The limit is of this process alone. Stacks have 8 MB, or what the limit of stacks says.
            const rlimit space{1024ul << 20, 1024ul << 20};
            setrlimit(RLIMIT_AS, &space);
            SilhouetteService service({.workers = 4096});
            const TrackerId id = service.add(model.octree, place(0));
            SilhouetteSnapshot start;
            const bool follows = service.snapshot(id, start) && service.post(id, place(1)) &&
                                 service.wait_for_change(id);
            _exit(follows && service.worker_count() < 4096 ? 0 : 1);
        }
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        CHECK(status == 0);
    }
}

}  // namespace
}  // namespace rimline
