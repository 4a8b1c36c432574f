#include "silhouette/hough/service/silhouette_follower.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <deque>
#include <new>
#include <random>

#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/hough/service/allocation_faults.h"
#include "tests/silhouette/hough/service/follower.h"
#include "tests/silhouette/hough/service/indexed_shape.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

// Holds what the calls say, as the GPU does, and refuses what would not fit on what it holds.
struct Consumer {
    std::uint64_t sequence = 0;
    std::vector<EdgeId> slots;
    std::vector<std::uint32_t> words;
    int applied = 0;
    int resent = 0;
    bool refuses = false;

    bool apply(const ChangeSet& changes) {
        if (refuses || changes.sequence != sequence + 1) return false;
        sequence = changes.sequence;
        slots.resize(changes.silhouette_size, k_no_edge);
        for (const SlotWrite& write : changes.slots) slots.at(write.slot) = write.edge;
        for (const WordWrite& write : changes.words) words.at(write.word) = write.bits;
        ++applied;
        return true;
    }
    void resend(const SilhouetteSnapshot& snapshot) {
        sequence = snapshot.sequence;
        slots = snapshot.slots;
        words = snapshot.words;
        ++resent;
    }
};

bool is_silhouette(const Mesh& mesh, const Consumer& consumer, const HomogeneousPoint& point) {
    return tests::ascending<EdgeId>(consumer.slots) ==
               tests::ascending<EdgeId>(brute_force_silhouette(mesh, point)) &&
           consumer.words == brute_force_face_bits(mesh, point);
}

TEST_CASE("a follower leads to exactly its point, whatever was announced, missed or refused") {
    const tests::IndexedShape model("knot", 600);
    constexpr std::uint32_t k_seed = 41;
    CAPTURE(k_seed);
    std::mt19937 random(k_seed);
    SilhouetteService service({.workers = 2, .max_pending = 2});
    struct Followed {
        Followed(SilhouetteService& service, const tests::IndexedShape& model, std::uint64_t seed)
            : walk(model.mesh, seed), follower(service, model.octree, walk.point()) {}
        tests::RandomWalk walk;
        SilhouetteFollower follower;
        Consumer consumer;
        int invalidated = 0;
        int stolen = 0;
    };
    std::deque<Followed> all;
    for (std::uint64_t i = 0; i < 4; ++i) all.emplace_back(service, model, k_seed + i);

    for (int frame = 0; frame < 1500; ++frame) {
        CAPTURE(frame);
        std::vector<HomogeneousPoint> points;
        for (Followed& f : all) {
            points.push_back(f.walk.next());
            switch (random() % 6) {
                case 0: break;                                      // Not announced.
                case 1: f.follower.announce(f.walk.next()); break;  // Wrongly.
                case 2: {
                    // Change sets of several points wait, and one goes missing: not the last, which
                    // the service never loses without a word.
                    const HomogeneousPoint between = f.walk.next();
                    f.follower.announce(between);
                    if (between == points.back()) break;
                    service.wait_idle();
                    PublishedChange change;
                    f.stolen += service.take(f.follower.tracker(), change) == Taken::change;
                    break;
                }
                case 3:
                    f.follower.announce(f.walk.next());
                    f.follower.announce(points.back());
                    f.follower.announce(f.walk.next());
                    break;
                default: f.follower.announce(points.back());
            }
            f.consumer.refuses = random() % 16 == 0;
            if (random() % 16 == 0) {
                f.follower.invalidate();
                ++f.invalidated;
            }
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            CAPTURE(i);
            all[i].follower.follow(points[i], all[i].consumer);
            REQUIRE(all[i].follower.point() == points[i]);
            REQUIRE(is_silhouette(model.mesh, all[i].consumer, points[i]));
        }
    }
    for (const Followed& f : all) {
        CHECK(f.stolen > 20);
        CHECK(f.consumer.applied > 500);
        CHECK(f.consumer.resent > f.invalidated / 2);
    }
}

TEST_CASE("a follower told of the state it has asks for nothing") {
    const tests::IndexedShape model("torus", 400);
    SilhouetteService service({.workers = 1});
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({3.0f, 1.0f, 0.5f});
    SilhouetteFollower follower(service, model.octree, point);
    Consumer consumer;
    follower.follow(point, consumer);
    for (int i = 0; i < 3; ++i) follower.follow(point, consumer);
    CHECK(consumer.resent == 1);
    CHECK(consumer.applied == 0);
    CHECK(service.counters().posts == 0);
    SilhouetteSnapshot state;
    follower.read_state(state);
    CHECK(state.slots == consumer.slots);
}

TEST_CASE("a consumer that throws has the whole state from the next call, at the same point too") {
    const tests::IndexedShape model("torus", 400);
    SilhouetteService service({.workers = 1});
    SilhouetteFollower follower(service, model.octree, HomogeneousPoint::viewpoint({3, 1, 0.5f}));
    struct Throwing : Consumer {
        bool in_apply = false, in_resend = false;
        bool apply(const ChangeSet& changes) {
            if (in_apply) throw std::bad_alloc();
            return Consumer::apply(changes);
        }
        void resend(const SilhouetteSnapshot& snapshot) {
            if (in_resend) throw std::bad_alloc();
            Consumer::resend(snapshot);
        }
    } consumer;
    follower.follow(HomogeneousPoint::viewpoint({3, 1, 0.5f}), consumer);

    const HomogeneousPoint point = HomogeneousPoint::viewpoint({-2, 0.5f, 2});
    consumer.in_apply = true;
    CHECK_THROWS_AS(follower.follow(point, consumer), std::bad_alloc);
    // The change set is taken, and will not come again; nor will what the snapshot stood for.
    follower.invalidate();
    consumer.in_resend = true;
    CHECK_THROWS_AS(follower.follow(point, consumer), std::bad_alloc);
    consumer.in_apply = consumer.in_resend = false;
    follower.follow(point, consumer);
    CHECK(is_silhouette(model.mesh, consumer, point));
    CHECK(consumer.resent == 2);
    CHECK(consumer.applied == 0);

    // The snapshot took the place of a change set that was lost.
    const HomogeneousPoint next = HomogeneousPoint::viewpoint({0, -3, 1});
    {
        const tests::AllocationFaults faults;
        follower.announce(next);
        service.wait_idle();
    }
    CHECK(service.counters().lost == 1);
    consumer.in_resend = true;
    CHECK_THROWS_AS(follower.follow(next, consumer), std::bad_alloc);
    consumer.in_resend = false;
    follower.follow(next, consumer);
    CHECK(is_silhouette(model.mesh, consumer, next));
}

TEST_CASE("a change set lost for want of memory becomes one whole state") {
    const tests::IndexedShape model("spring", 2000);
    SilhouetteService service({.workers = 1});
    SilhouetteFollower follower(service, model.octree, HomogeneousPoint::viewpoint({3, 1, 0.5f}));
    Consumer consumer;
    follower.follow(HomogeneousPoint::viewpoint({3, 1, 0.5f}), consumer);
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({-2, 0.5f, 2});
    {
        const tests::AllocationFaults faults;
        follower.announce(point);
        service.wait_idle();
    }
    CHECK(service.counters().lost == 1);
    follower.follow(point, consumer);
    CHECK(consumer.resent == 2);
    CHECK(is_silhouette(model.mesh, consumer, point));
}

TEST_CASE("a stopped service ends a follower with an error, not a wait") {
    const tests::IndexedShape model("torus", 400);
    SilhouetteService service({.workers = 1});
    SilhouetteFollower follower(service, model.octree, HomogeneousPoint::viewpoint({3, 1, 0.5f}));
    Consumer consumer;
    service.stop();
    follower.announce(HomogeneousPoint::viewpoint({3, 1, 1}));
    try {
        follower.follow(HomogeneousPoint::viewpoint({3, 1, 2}), consumer);
        FAIL("followed");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace rimline
