#include "silhouette/points/point_order.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/points/point_tree.h"
#include "silhouette/points/stoppable_sort.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

template <typename Body>
bool is_cancelled(Body&& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.code() == ErrorCode::cancelled;
    }
    return false;
}

TEST_CASE("ordering points stops where that is asked") {
    const auto points = tests::make_sphere(1000);
    CHECK(order_points(points).positions.size() == points.size());
    std::stop_source stop;
    CHECK(order_points(points, stop.get_token()).positions.size() == points.size());
    stop.request_stop();
    CHECK(is_cancelled([&] { order_points(points, stop.get_token()); }));
}

TEST_CASE("a tree of points stops while it is built") {
    const auto points = tests::make_sphere(100000);
    std::stop_source stop;
    const TreeBuildPoints source(points, stop.get_token());
    CHECK_NOTHROW(PointTree(3, source, point_tree_leaves()));
    stop.request_stop();
    CHECK(is_cancelled([&] { PointTree(3, source, point_tree_leaves()); }));
}

// On one thread, so that the same is compared each time. A thread that is asked to stop divides its part to the end,
// which compares up to twice as many elements as the part has.
TEST_CASE("a stopped sort compares few elements more") {
    std::vector<std::uint32_t> shuffled(300000);
    tests::Random random(1);
    for (std::uint32_t& number : shuffled)
        number = static_cast<std::uint32_t>(random.below(1u << 30));
    tbb::task_arena one_thread(1);
    std::uint64_t compared = 0;
    std::vector<std::uint32_t> sorted = shuffled;
    one_thread.execute([&] {
        stoppable_sort(sorted.begin(), sorted.end(), {}, [&](std::uint32_t a, std::uint32_t b) {
            ++compared;
            return a < b;
        });
    });
    CHECK(std::ranges::is_sorted(sorted));
    const std::uint64_t all = compared;
    for (const double share : {0.1, 0.3, 0.5, 0.7}) {
        CAPTURE(share);
        const auto moment = static_cast<std::uint64_t>(share * static_cast<double>(all));
        compared = 0;
        std::stop_source stop;
        std::vector<std::uint32_t> partly = shuffled;
        CHECK(is_cancelled([&] {
            one_thread.execute([&] {
                stoppable_sort(partly.begin(), partly.end(), stop.get_token(),
                               [&](std::uint32_t a, std::uint32_t b) {
                                   if (++compared == moment) stop.request_stop();
                                   return a < b;
                               });
            });
        }));
        CHECK(compared < moment + 2 * shuffled.size());
        // Nothing is lost.
        std::ranges::sort(partly);
        CHECK(partly == sorted);
    }
}

}  // namespace
}  // namespace rimline
