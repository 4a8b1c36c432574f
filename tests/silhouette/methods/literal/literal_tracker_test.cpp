#include "silhouette/methods/literal/literal_tracker.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <numbers>
#include <type_traits>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/random_walk.h"
#include "tests/silhouette/methods/literal/literal_walk.h"

namespace rimline {
namespace {

static_assert(!std::is_constructible_v<LiteralTracker, LiteralOctree, HomogeneousPoint>);

constexpr std::array k_exact{LiteralUpdate::full_traversal, LiteralUpdate::incremental};

std::uint32_t wrong_bits(const LiteralTracker& tracker, const Mesh& mesh) {
    const std::vector<std::uint32_t> right = brute_force_face_bits(mesh, tracker.point());
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < right.size(); ++i)
        wrong += static_cast<std::uint32_t>(std::popcount(right[i] ^ tracker.face_words()[i]));
    return wrong;
}

TEST_CASE("both literal updates equal brute force on every move on every made mesh") {
    for (const auto& [name, source] : tests::made_meshes(2000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const LiteralOctree octree(mesh);
        for (const LiteralUpdate update : k_exact)
            tests::check_literal_walk(octree, {update}, 250, 111);
    }
}

TEST_CASE("literal updates are right from every origin and with every size of leaf") {
    for (const auto& [name, source] : tests::made_meshes(500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const double r = mesh.radius();
        for (const glm::dvec3& origin :
             {glm::dvec3(0.0), mesh.center() + glm::dvec3(r, 0.1 * r, 0.0)})
            for (const PointOctreeOptions& tree :
                 {PointOctreeOptions{1, 48}, PointOctreeOptions{9, 48}, PointOctreeOptions{1, 3}}) {
                LiteralOctreeOptions options;
                options.origin = origin;
                options.octree = tree;
                options.small_leaf = tree.max_depth == 3 ? 0 : 1;
                const LiteralOctree octree(mesh, options);
                for (const LiteralUpdate update : k_exact)
                    tests::check_literal_walk(octree, {update}, 40, 112);
            }
    }
}

// Parallel triangles at x from -1 to 1: all Hough points are on one line, and so is the root.
MeshSource stack_of_triangles(std::uint32_t count) {
    MeshSource stack;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float x = 2.0f * static_cast<float>(i) / static_cast<float>(count - 1) - 1.0f;
        stack.positions.insert(stack.positions.end(),
                               {{x, -0.5f, -0.5f}, {x, 0.5f, -0.5f}, {x, 0.0f, 0.5f}});
        stack.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return stack;
}

TEST_CASE("the walk finds what turns far from where the previous v-sphere meets the root") {
    const Mesh mesh(stack_of_triangles(200));
    const LiteralOctree octree(mesh);
    for (const LiteralUpdate update : k_exact) {
        // Both v-spheres meet the line near 0 and at the viewpoint. The first one's is beyond its end.
        LiteralTracker tracker(octree, HomogeneousPoint::viewpoint({6.0f, 0.0f, 0.0f}), {update});
        tracker.move_to(HomogeneousPoint::viewpoint({0.6f, 0.0f, 0.0f}));
        CHECK(tracker.turned().size() == 40);
        CHECK(wrong_bits(tracker, mesh) == 0);
        tests::check_literal_walk(octree, {update}, 1000, 113);
    }
}

TEST_CASE("the walk as written loses faces, the walk and the traversal do not") {
    // All Hough points of a sphere around the origin are far from it. From inside, the v-sphere is
    // smaller and meets none: the active set is empty, and the walk of the text finds nothing from then on.
    const Mesh sphere(make_built_in_shape("sphere", 2000));
    const LiteralOctree octree(sphere);
    const HomogeneousPoint inside = HomogeneousPoint::viewpoint({0.05f, 0.02f, 0.01f});
    const HomogeneousPoint outside = HomogeneousPoint::viewpoint({2.0f, 1.0f, 0.5f});
    LiteralTracker as_written(octree, inside, {LiteralUpdate::incremental_as_written});
    CHECK(as_written.active_set_size() == 0);
    as_written.move_to(outside);
    CHECK(as_written.turned().empty());
    CHECK(wrong_bits(as_written, sphere) > 100);
    for (const LiteralUpdate update : k_exact) {
        LiteralTracker tracker(octree, inside, {update});
        tracker.move_to(outside);
        CHECK(wrong_bits(tracker, sphere) == 0);
        CHECK(tracker.turned().size() > 100);
    }
}

TEST_CASE("as written, random walks go wrong on most meshes") {
    std::uint32_t gone_wrong = 0;
    std::uint32_t meshes = 0;
    for (const std::string_view shape : k_built_in_shapes) {
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const LiteralOctree octree(mesh);
        tests::RandomWalk walk(mesh, 114);
        LiteralTracker tracker(octree, walk.point(), {LiteralUpdate::incremental_as_written});
        std::uint32_t wrong = 0;
        for (int i = 0; i < 200; ++i) {
            tracker.move_to(walk.next());
            wrong += wrong_bits(tracker, mesh);
        }
        ++meshes;
        gone_wrong += wrong > 0;
    }
    CHECK(2 * gone_wrong > meshes);
}

TEST_CASE("a move to where the tracker is turns no face") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const LiteralOctree octree(mesh);
    const HomogeneousPoint p = HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f});
    for (const LiteralUpdate update : k_exact) {
        LiteralTracker tracker(octree, p, {update});
        tracker.move_to(p);
        CHECK(tracker.turned().empty());
        CHECK(tracker.counters().contained_faces == 0);
        CHECK(tracker.counters().edge_tests == 0);
    }
}

struct OrbitWork {
    LiteralCounters work;
    std::uint64_t turned = 0;
};

OrbitWork work_of_orbit(const LiteralOctree& octree, const LiteralTrackerOptions& options,
                        double step_rad, std::uint32_t moves) {
    const Mesh& mesh = octree.mesh();
    const Orbit orbit(mesh.center(), {0.0, 1.0, 0.0}, 2.0 * mesh.radius());
    LiteralTracker tracker(octree, orbit.viewpoint(0.0), options);
    OrbitWork sum;
    for (std::uint32_t i = 1; i <= moves; ++i) {
        sum.work += tracker.move_to(orbit.viewpoint(i * step_rad));
        sum.turned += tracker.turned().size();
        REQUIRE(wrong_bits(tracker, mesh) == 0);
    }
    return sum;
}

constexpr double k_degree = std::numbers::pi / 180.0;

TEST_CASE("turning contained nodes whole saves face checks and box checks") {
    const Mesh mesh(make_built_in_shape("knot", 20000));
    const LiteralOctree octree(mesh);
    for (const LiteralUpdate update : k_exact) {
        const OrbitWork whole = work_of_orbit(octree, {update, true}, 10.0 * k_degree, 36);
        const OrbitWork each = work_of_orbit(octree, {update, false}, 10.0 * k_degree, 36);
        CHECK(whole.turned == each.turned);
        CHECK(each.work.contained_faces == 0);
        CHECK(whole.work.contained_faces > whole.turned / 4);
        CHECK(whole.work.contained_faces <= whole.turned);
        CHECK(whole.work.face_checks < each.work.face_checks);
        CHECK(whole.work.pbv_checks < each.work.pbv_checks);
    }
}

TEST_CASE("what a small step looks at is a small part of the mesh") {
    const Mesh mesh(make_built_in_shape("knot", 40000));
    const LiteralOctree octree(mesh);
    const std::uint32_t moves = 60;
    for (const LiteralUpdate update : k_exact) {
        const OrbitWork sum = work_of_orbit(octree, {update}, 0.5 * k_degree, moves);
        CHECK(sum.turned > 10 * moves);
        CHECK(sum.work.face_checks < std::uint64_t{moves} * mesh.face_count() / 10);
        CHECK(sum.work.pbv_checks < std::uint64_t{moves} * octree.statistics().nodes / 10);
    }
}

// The walk avoids the PBVs above the active-set candidates. It tests octants along the v-sphere instead.
TEST_CASE("a walk tests fewer PBVs than a traversal, and OBVs instead") {
    const Mesh mesh(make_built_in_shape("knot", 40000));
    const LiteralOctree octree(mesh);
    const OrbitWork full =
        work_of_orbit(octree, {LiteralUpdate::full_traversal}, 0.5 * k_degree, 60);
    const OrbitWork walk = work_of_orbit(octree, {LiteralUpdate::incremental}, 0.5 * k_degree, 60);
    CHECK(full.turned == walk.turned);
    CHECK(2 * walk.work.pbv_checks < full.work.pbv_checks);
    CHECK(walk.work.face_checks <= full.work.face_checks);
    CHECK(full.work.obv_checks == 0);
    CHECK(full.work.nodes_enqueued == 0);
    CHECK(walk.work.obv_checks > 0);
    CHECK(walk.work.obv_checks < 60 * octree.search_cells().cells.size() / 4);
    CHECK(walk.work.nodes_enqueued > 0);
}

TEST_CASE("active sets do not grow over a long way" * doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("torus", 3000));
    const LiteralOctree octree(mesh);
    tests::RandomWalk walk(mesh, 115);
    LiteralTracker moved(octree, walk.point());
    for (int i = 0; i < 300; ++i) {
        moved.move_to(walk.next());
        const LiteralTracker fresh(octree, walk.point());
        REQUIRE(moved.active_set_size() <= fresh.active_set_size());
    }
}

}  // namespace
}  // namespace rimline
