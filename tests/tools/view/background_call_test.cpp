#include "tools/view/background_call.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

using FaceCount = BackgroundCall<std::uint32_t>;

// Makes a mesh and its octree, as the window does, and counts faces; 0 if it was cancelled.
FaceCount::Work count_faces(const char* shape, std::uint32_t faces) {
    return [shape, faces](const BeginCall& begin) -> std::uint32_t {
        try {
            const Mesh mesh(make_built_in_shape(shape, faces), Welding::equal_positions,
                            begin("welding"));
            const HoughOctree octree(mesh, {}, begin("building"));
            return octree.statistics().faces;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cancelled) throw;
            return 0;
        }
    };
}

template <typename Condition>
void wait_until(const Condition& condition) {
    while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::uint32_t wait_for(FaceCount& call) {
    std::optional<std::uint32_t> result;
    wait_until([&] { return (result = call.take()).has_value(); });
    return *result;
}

}  // namespace

TEST_SUITE_BEGIN("threads");

TEST_CASE("a call has a result once and wakes whoever waits for it") {
    std::atomic<int> wakes{0};
    FaceCount call([&] { ++wakes; });
    CHECK_FALSE(call.stage());
    CHECK_FALSE(call.take());
    call.start("opening", count_faces("torus", 20'000));
    CHECK(wait_for(call) > 15'000);
    CHECK(wakes >= 3);  // Two stages and the result.
    CHECK_FALSE(call.stage());
    CHECK_FALSE(call.take());
}

TEST_CASE("the stage is the task begun last and progress wakes in steps of a hundredth") {
    std::atomic<int> wakes{0};
    std::atomic<int> step{0};
    FaceCount call([&] { ++wakes; });
    call.start("opening", [&](const BeginCall& begin) -> std::uint32_t {
        wait_until([&] { return step >= 1; });
        const LongCall task = begin("reading");
        for (int i = 0; i <= 500; ++i) task.progress(i / 1000.0);
        step = 2;
        wait_until([&] { return step >= 3; });
        return 7;
    });
    REQUIRE(call.stage());
    CHECK(call.stage()->task == "opening");
    CHECK(call.stage()->share == 0.0);
    step = 1;
    wait_until([&] { return step >= 2; });
    REQUIRE(call.stage());
    CHECK(call.stage()->task == "reading");
    CHECK(call.stage()->share == doctest::Approx(0.5).epsilon(0.02));
    CHECK(wakes >= 46);
    CHECK(wakes <= 51);
    step = 3;
    CHECK(wait_for(call) == 7);
}

TEST_CASE("starting another call drops the one before and cancelling drops all") {
    FaceCount call;
    for (int i = 0; i < 20; ++i) call.start("opening", count_faces("knot", 50'000));
    call.start("opening", count_faces("sphere", 500));
    const std::uint32_t faces = wait_for(call);
    CHECK(faces > 300);
    CHECK(faces < 1000);
    call.start("opening", count_faces("knot", 50'000));
    call.cancel();
    CHECK_FALSE(call.take());
    CHECK_FALSE(call.stage());
}

TEST_CASE("cancelling waits for nothing and what was cancelled changes nothing any more") {
    std::atomic<bool> ends{false};
    std::atomic<bool> has_ended{false};
    FaceCount call;
    call.start("deaf", [&](const BeginCall& begin) -> std::uint32_t {
        wait_until([&] { return ends.load(); });  // It does not ask whether it is to stop.
        begin("late").progress(0.5);
        has_ended = true;
        return 1;
    });
    call.cancel();
    call.start("next", [&](const BeginCall&) -> std::uint32_t {
        wait_until([&] { return has_ended.load(); });
        return 2;
    });
    CHECK(call.stage()->task == "next");
    ends = true;
    CHECK(wait_for(call) == 2);
    CHECK_FALSE(call.take());
}

TEST_CASE("a call ends before what it works on goes") {
    for (int i = 0; i < 20; ++i) {
        std::atomic<bool> is_running{false};
        {
            FaceCount call;
            call.start("spinning", [&](const BeginCall& begin) -> std::uint32_t {
                const LongCall task = begin("spinning");
                is_running = true;
                while (!task.stop.stop_requested()) std::this_thread::yield();
                is_running = false;
                return 0;
            });
            if (i % 2 == 0) wait_until([&] { return is_running.load(); });
        }
        CHECK_FALSE(is_running);
    }
}

TEST_SUITE_END();
