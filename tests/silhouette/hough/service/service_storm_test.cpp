// Everything at once from several threads: what the thread sanitizer is for, and what must be left
// right when the storm is over.

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "silhouette/hough/service/silhouette_service.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/service/follower.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

class Storm {
public:
    Storm(const HoughOctree& octree, std::uint64_t seed)
        : octree_(&octree), seed_(seed), service_({.workers = 2, .max_pending = 2}) {
        tests::ProbePoints probes(octree.mesh(), seed);
        for (HomogeneousPoint& point : points_) point = probes.next();
        for (std::atomic<TrackerId>& id : ids_) id = service_.add(octree, points_[0]);
    }

    SilhouetteService& service() { return service_; }
    TrackerId id(std::uint32_t place) const { return ids_[place]; }
    static constexpr std::uint32_t size() { return k_size; }

    void post(std::uint32_t thread, std::uint32_t count) {
        std::mt19937_64 random(seed_ + thread);
        for (std::uint32_t i = 0; i < count; ++i)
            service_.post(ids_[random() % k_size], points_[random() % points_.size()]);
    }

    void replace(std::uint32_t thread, std::uint32_t count) {
        std::mt19937_64 random(seed_ + thread);
        try {
            for (std::uint32_t i = 0; i < count; ++i) {
                const TrackerId id = service_.add(*octree_, points_[random() % points_.size()]);
                const TrackerId old = ids_[random() % k_size].exchange(id);
                service_.post(old, points_[random() % points_.size()]);
                wrong_removals_ += !service_.remove(old);
                wrong_removals_ += service_.remove(old);
            }
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) throw;  // Else the service was stopped.
        }
    }

    // One thread's only.
    void consume(std::uint32_t thread, std::uint32_t count) {
        std::mt19937_64 random(seed_ + thread);
        PublishedChange change;
        SilhouetteSnapshot snapshot;
        for (std::uint32_t i = 0; i < count; ++i) {
            const TrackerId id = ids_[random() % k_size];
            switch (random() % 16) {
                case 0: service_.snapshot(id, snapshot); break;
                case 1: service_.wait_idle(); break;
                case 2:  // Nobody else takes, so that something comes.
                    if (service_.post(id, points_[random() % points_.size()]) &&
                        service_.wait_for_change(id))
                        service_.take(id, change);
                    break;
                default: service_.take(id, change);
            }
        }
    }

    std::uint32_t wrong_removals() const { return wrong_removals_; }
    const HomogeneousPoint& point(std::uint32_t i) const { return points_[i]; }

private:
    static constexpr std::uint32_t k_size = 8;

    const HoughOctree* octree_;
    std::uint64_t seed_;
    SilhouetteService service_;
    std::array<HomogeneousPoint, 32> points_;
    std::array<std::atomic<TrackerId>, k_size> ids_{};
    std::atomic<std::uint32_t> wrong_removals_{0};
};

TEST_CASE("trackers come, go, are posted to and taken from by many threads, and end up right") {
    const Mesh mesh(make_built_in_shape("torus", 600));
    const HoughOctree octree(mesh);
    const std::uint64_t seed = 51;
    CAPTURE(seed);
    Storm storm(octree, seed);
    std::vector<std::thread> threads;
    for (std::uint32_t t = 0; t < 2; ++t) {
        threads.emplace_back([&, t] { storm.post(3 * t, 6000); });
        threads.emplace_back([&, t] { storm.replace(3 * t + 1, 300); });
    }
    std::atomic<bool> is_over{false};
    std::thread consumer([&] {
        while (!is_over) storm.consume(99, 200);
    });
    for (std::thread& thread : threads) thread.join();
    is_over = true;
    consumer.join();
    CHECK(storm.wrong_removals() == 0);

    SilhouetteService& service = storm.service();
    PublishedChange change;
    SilhouetteSnapshot snapshot;
    for (std::uint32_t t = 0; t < Storm::size(); ++t) {
        CAPTURE(t);
        const TrackerId id = storm.id(t);
        tests::Follower follower(mesh);
        REQUIRE(service.snapshot(id, snapshot));
        CHECK(follower.begin(snapshot) == std::nullopt);
        REQUIRE(service.post(id, storm.point(31 - t)));
        while (follower.point() != storm.point(31 - t)) {
            REQUIRE(service.wait_for_change(id));
            REQUIRE(service.take(id, change) == Taken::change);
            REQUIRE(follower.follow(change.view()) == std::nullopt);
        }
    }
}

TEST_CASE("a stop in the middle of everything ends all calls") {
    const Mesh mesh(make_built_in_shape("spring", 600));
    const HoughOctree octree(mesh);
    for (std::uint64_t seed = 61; seed < 69; ++seed) {
        CAPTURE(seed);
        Storm storm(octree, seed);
        std::vector<std::thread> threads;
        threads.emplace_back([&] { storm.post(0, 3000); });
        threads.emplace_back([&] { storm.replace(1, 100); });
        threads.emplace_back([&] { storm.consume(2, 3000); });
        threads.emplace_back([&] { storm.service().stop(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(seed - 60));
        storm.service().stop();
        CHECK(!storm.service().post(storm.id(0), storm.point(0)));
        for (std::thread& thread : threads) thread.join();
        CHECK(storm.wrong_removals() == 0);
    }
}

}  // namespace
}  // namespace rimline
