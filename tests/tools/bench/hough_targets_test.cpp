#include "tools/bench/hough_targets.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/tools/bench/made_results.h"

namespace rimline::tools {
namespace {

TEST_CASE("the three meshes of the table have goals of their own and others the general rule") {
    CHECK(first_missed(targets_of(result_of(1000, 1.0, 1.0))).empty());
    CHECK(targets_of(result_of(1000, 1.0, 1.0)).size() == 2);
    CHECK(first_missed(targets_of(result_of(1000, 0.99, 1.0))) ==
          "extraction, brute force over octree");
    CHECK(first_missed(targets_of(result_of(1000, 1.0, 0.99))) ==
          "update, brute force tracker over tracker");
    CHECK(first_missed(targets_of(result_of(k_bunny_faces, 1.0, 1.0))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_bunny_faces, 0.9, 1.0))).empty());
    CHECK(first_missed(targets_of(result_of(k_igea_faces, 4.0, 3.5))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_igea_faces, 4.0, 3.4))).empty());
    CHECK(first_missed(targets_of(result_of(k_large_faces, 9.0, 11.0))).empty());
    CHECK_FALSE(first_missed(targets_of(result_of(k_large_faces, 8.9, 11.0))).empty());
}

TEST_CASE("brute force above its ceiling is missed on every mesh") {
    ModelResult result = result_of(k_min_ceiling_faces, 10.0, 10.0);
    result.ceiling = brute_force_ceiling(k_min_ceiling_faces, 100.0, 199.0);
    CHECK(first_missed(targets_of(result)).empty());
    result.ceiling = brute_force_ceiling(k_min_ceiling_faces, 100.0, 201.0);
    CHECK(first_missed(targets_of(result)) == "brute force over its ceiling");
}

TEST_CASE("each of igea's other goals can be missed, and a time fails nothing") {
    const auto good = [] { return result_of(k_igea_faces, 4.0, 3.5); };
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

}  // namespace
}  // namespace rimline::tools
