#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/bench/ceiling.h"
#include "tools/bench/fresh_tracker.h"
#include "tools/bench/growth.h"
#include "tools/bench/targets.h"
#include "tools/commands/stream_bytes.h"
#include "tools/options/track_path.h"
#include "tools/timing.h"

namespace rimline::tools {
namespace {

Times times_of(double us) { return {"made", false, {us, us, us}, {{}, {}, {}}, {}}; }

// A model on which brute force takes so many times as long as ours.
ModelResult result_of(std::uint32_t faces, double extraction, double update) {
    ModelResult result;
    result.faces = faces;
    result.extraction.methods = {times_of(10.0), times_of(10.0 * extraction)};
    result.update.methods = {times_of(3.0), times_of(3.0 * update)};
    result.octree_bytes = 100 * std::uint64_t{faces};
    result.tracker_bytes = 50 * std::uint64_t{faces};
    result.stream = {1, 5};
    result.worst_update = WorstUpdate{1.0, 1.2, 3.0};
    return result;
}

TEST_CASE("a quantile is the least value that the share does not exceed") {
    const std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
    CHECK(quantile(values, 0.0) == 1.0);
    CHECK(quantile(values, 0.2) == 1.0);
    CHECK(quantile(values, 0.21) == 2.0);
    CHECK(quantile(values, 0.5) == 3.0);
    CHECK(quantile(values, 0.999) == 5.0);
    CHECK(quantile(values, 1.0) == 5.0);
    CHECK(quantile({7.0}, 0.5) == 7.0);
}

TEST_CASE("timing takes every contender in turn, the first round to warm up and count") {
    const std::vector<HomogeneousPoint> points(5, HomogeneousPoint::viewpoint({1, 2, 3}));
    std::vector<char> order;
    const auto contender = [&](char name, std::size_t every) {
        return Contender{.name = std::string(1, name),
                         .step = [&order, name](const HomogeneousPoint&) { order.push_back(name); },
                         .counters =
                             [] {
                                 return TraversalCounters{1, 2, 4};
                             },
                         .prepare = [&order] { order.push_back('('); },
                         .own_counts =
                             [&order] {
                                 return std::vector<NamedCount>{{"steps", order.size()}};
                             },
                         .every = every};
    };
    const std::vector<Contender> contenders{contender('a', 1), contender('b', 2)};
    const std::vector<Times> times = time_in_turn(contenders, points, 1, "", {});
    CHECK(std::string(order.begin(), order.end()) == "(aaaaa(bbb(aaaaa(bbb");
    CHECK(times[0].us.size() == 5);
    CHECK(times[1].us.size() == 3);
    CHECK(times[0].mean_work().edge_checks == 4);
    CHECK(times[0].own_counts[0].mean == (2 + 3 + 4 + 5 + 6) / 5.0);
    for (const double us : times[0].us) CHECK((us >= 0.0 && us < 1e6));
}

TEST_CASE("the three meshes of the table have goals of their own and others the general rule") {
    CHECK(first_missed(targets_of(result_of(1000, 1.0, 1.0))).empty());
    CHECK(targets_of(result_of(1000, 1.0, 1.0)).size() == 2);
    CHECK(first_missed(targets_of(result_of(1000, 0.99, 1.0))) ==
          "extraction, brute force over octree");
    CHECK(first_missed(targets_of(result_of(1000, 1.0, 0.99))) ==
          "update, brute force tracker over tracker");
    CHECK(first_missed(targets_of(result_of(k_bunny_faces, 2.0, 1.0))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_bunny_faces, 1.9, 1.0))).empty());
    CHECK(first_missed(targets_of(result_of(k_igea_faces, 5.0, 10.0))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_igea_faces, 5.0, 9.9))).empty());
    CHECK(first_missed(targets_of(result_of(k_large_faces, 15.0, 20.0))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_large_faces, 14.9, 20.0))).empty());
}

TEST_CASE("each of igea's other goals can be missed, and a time fails nothing") {
    const auto good = [] { return result_of(k_igea_faces, 5.0, 10.0); };
    ModelResult result = good();
    result.worst_update->work = 1.6;
    CHECK_FALSE(first_missed(targets_of(result)).empty());
    result = good();
    result.worst_update->p999 = 1.6;
    CHECK_FALSE(first_missed(targets_of(result)).empty());
    result = good();
    result.octree_bytes = 151 * std::uint64_t{k_igea_faces};
    CHECK_FALSE(first_missed(targets_of(result)).empty());
    result = good();
    result.stream = {3, 10};
    CHECK_FALSE(first_missed(targets_of(result)).empty());
    result = good();
    result.vtk.us = {299.0 * 3.0};
    CHECK_FALSE(first_missed(targets_of(result)).empty());
    result.vtk.us = {301.0 * 3.0};
    CHECK(first_missed(targets_of(result)).empty());
    result.build_ms = 61.0;
    CHECK(first_missed(targets_of(result)).empty());
    CHECK_FALSE(std::ranges::all_of(targets_of(result), &Target::is_reached));
}

TEST_CASE("the octree overtakes between sizes, on a straight line of the logarithms") {
    const auto step = [](std::uint32_t faces, double extraction) {
        return GrowthStep{result_of(faces, extraction, 2.0), 0};
    };
    const auto at = [](const std::vector<GrowthStep>& steps) {
        return overtaken_at(steps, &ModelResult::extraction);
    };
    CHECK(*at({step(100, 0.5), step(10'000, 2.0)}) == doctest::Approx(1000.0));
    CHECK(*at({step(100, 2.0), step(1000, 0.5), step(4000, 2.0)}) == doctest::Approx(2000.0));
    CHECK(*at({step(100, 1.5), step(1000, 2.0)}) == 100.0);
    CHECK_FALSE(at({step(100, 2.0), step(1000, 0.9)}).has_value());
    CHECK(*overtaken_at({step(100, 0.5)}, &ModelResult::update) == 100.0);
}

TEST_CASE("the ceiling grows with the plain loop and is a verdict with AVX-512 alone") {
    CHECK_FALSE(brute_force_ceiling(1000, "AVX-512", 1.0, 1.0).has_value());
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 400.0)->ceiling_us ==
          doctest::Approx(1.25 * 330.0));
    CHECK(brute_force_ceiling(k_bunny_faces, "AVX-512", 28.0, 100.0)->ceiling_us ==
          doctest::Approx(2.0 * 1.25 * 63.0));
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 412.0)->verdict() == "ok");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 413.0)->verdict() == "defect");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX2", 137.0, 413.0)->verdict() == "unknown");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX2", 137.0, 412.0)->verdict() == "ok");
}

TEST_CASE("the plain loop counts the faces that brute force finds to be front") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const PlainLoop plain(mesh);
    for (const HomogeneousPoint& point : random_path(mesh, 3, 50)) {
        std::uint32_t front = 0;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            front += is_front(mesh.plane(FaceId{f}), point) ? 1u : 0u;
        CHECK(plain.count_front(point) == front);
    }
}

TEST_CASE("a fresh tracker finds what brute force finds on a random path") {
    const Mesh mesh(make_built_in_shape("spring", 3000));
    const HoughOctree octree(mesh);
    const std::vector<HomogeneousPoint> path = random_path(mesh, 5, 200);
    FreshTracker fresh(octree, path.front());
    for (const HomogeneousPoint& point : path) {
        const ChangeSet& change = fresh.move_to(point);
        std::vector<EdgeId> edges(fresh.silhouette().begin(), fresh.silhouette().end());
        std::sort(edges.begin(), edges.end());
        REQUIRE(edges == brute_force_silhouette(mesh, point));
        REQUIRE(std::ranges::equal(fresh.face_words(), brute_force_face_bits(mesh, point)));
        REQUIRE(change.counters.face_checks >= mesh.face_count());
    }
}

TEST_CASE("what is streamed is the writes, or the whole state where that is less") {
    const std::array<SlotWrite, 2> slots{};
    const std::array<WordWrite, 3> words{};
    ChangeSet change;
    change.silhouette_size = 10;
    change.slots = slots;
    change.words = words;
    CHECK(stream_bytes(change, 5).streamed == 2 * 8 + 3 * 8);
    CHECK(stream_bytes(change, 5).full == 10 * 4 + 5 * 4);
    change.silhouette_size = 2;
    CHECK(stream_bytes(change, 5).streamed == 2 * 4 + 5 * 4);
}

}  // namespace
}  // namespace rimline::tools
