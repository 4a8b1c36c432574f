#include "silhouette/methods/method_registry.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

// For a method that takes directions only: the direction to the viewpoint.
HomogeneousPoint as_taken_by(const SilhouetteMethodInfo& info, const HomogeneousPoint& point) {
    return info.directions_only ? HomogeneousPoint::direction(point.xyz()) : point;
}

using Call = void (SilhouetteMethod::*)(const HomogeneousPoint&, std::vector<EdgeId>&,
                                        TraversalCounters&);

void check_call(SilhouetteMethod& method, Call call, const Mesh& mesh, const HomogeneousPoint& p) {
    CAPTURE(p.x);
    CAPTURE(p.y);
    CAPTURE(p.z);
    CAPTURE(p.w);
    std::vector<EdgeId> edges{k_no_edge};  // extract() must replace it.
    TraversalCounters counters;
    (method.*call)(p, edges, counters);
    std::sort(edges.begin(), edges.end());
    REQUIRE(edges == brute_force_silhouette(mesh, p));
}

template <typename Check>
void for_each_exact_method(const Mesh& mesh, const SilhouetteMethodOptions& options,
                           Check&& check) {
    for (const SilhouetteMethodInfo& info : silhouette_methods()) {
        if (!info.exact) continue;
        const std::string method_name(info.name);
        CAPTURE(method_name);
        const std::unique_ptr<SilhouetteMethod> method =
            make_silhouette_method(info.name, mesh, options);
        REQUIRE(method != nullptr);
        check(info, *method);
    }
}

TEST_CASE("the registry has every method that a bench compares, with its source") {
    const std::set<std::string_view> expected{
        "octree",     "literal", "brute",   "brute-scalar", "edge-buffer", "dual",
        "plane-tree", "gauss",   "quadric", "cone-tree",    "randomised"};
    std::set<std::string_view> names;
    const Mesh mesh(make_built_in_shape("sphere", 100));
    for (const SilhouetteMethodInfo& info : silhouette_methods()) {
        CHECK(names.insert(info.name).second);
        CHECK_FALSE(info.summary.empty());
        CHECK_FALSE(info.source.empty());
        CHECK(info.exact == (info.name != "randomised"));
        CHECK(info.directions_only == (info.name == "gauss"));
        CHECK(find_silhouette_method(info.name) == &info);
        CHECK(make_silhouette_method(info.name, mesh) != nullptr);
    }
    CHECK(names == expected);
    CHECK(find_silhouette_method("Octree") == nullptr);
    CHECK(make_silhouette_method("", mesh) == nullptr);
}

TEST_CASE("every exact method extracts what brute force does, on every kind of mesh") {
    const std::uint64_t seed = 81;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(1500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for_each_exact_method(mesh, {}, [&](const auto& info, SilhouetteMethod& method) {
            tests::ProbePoints probes(mesh, seed);
            for (std::uint32_t i = 0; i < tests::rounds(200u); ++i)
                check_call(method, &SilhouetteMethod::extract, mesh,
                           as_taken_by(info, probes.next()));
        });
    }
}

TEST_CASE("every exact method follows a point as brute force finds it, on every kind of mesh") {
    const std::uint64_t seed = 82;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(1500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for_each_exact_method(mesh, {}, [&](const auto& info, SilhouetteMethod& method) {
            tests::RandomWalk walk(mesh, seed);
            for (std::uint32_t i = 0; i < tests::rounds(200u); ++i)
                check_call(method, &SilhouetteMethod::update, mesh, as_taken_by(info, walk.next()));
        });
    }
}

TEST_CASE("every exact method is right from other origins and with calls of both kinds mixed" *
          doctest::test_suite("plain")) {
    const std::uint64_t seed = 83;
    CAPTURE(seed);
    for (const auto& [name, source] : tests::made_meshes(500)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const double r = mesh.radius();
        const glm::dvec3 vertex =
            mesh.vertex_count() > 0 ? glm::dvec3(mesh.positions()[0]) : glm::dvec3(0.0);
        for (const glm::dvec3& origin :
             {glm::dvec3(0.0), vertex, mesh.center() + glm::dvec3(r / 3.0, 20.0 * r, -r / 5.0)}) {
            CAPTURE(origin.x);
            CAPTURE(origin.y);
            SilhouetteMethodOptions options;
            options.origins = {origin};
            for_each_exact_method(mesh, options, [&](const auto& info, SilhouetteMethod& method) {
                tests::RandomWalk walk(mesh, seed);
                for (std::uint32_t i = 0; i < tests::rounds(40u); ++i)
                    check_call(method,
                               i % 3 == 0 ? &SilhouetteMethod::extract : &SilhouetteMethod::update,
                               mesh, as_taken_by(info, walk.next()));
            });
        }
    }
}

TEST_CASE("the Gauss map refuses viewpoints") {
    const Mesh mesh(make_built_in_shape("torus", 500));
    const std::unique_ptr<SilhouetteMethod> gauss = make_silhouette_method("gauss", mesh);
    std::vector<EdgeId> edges;
    TraversalCounters counters;
    const HomogeneousPoint viewpoint = HomogeneousPoint::viewpoint({1.0f, 2.0f, 3.0f});
    CHECK_THROWS_AS(gauss->extract(viewpoint, edges, counters), Error);
    CHECK_THROWS_AS(gauss->update(viewpoint, edges, counters), Error);
}

TEST_CASE("a tree tests a small part of a large mesh and counts it" *
          doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("torus", 60000));
    REQUIRE(mesh.face_count() > 40000);
    for (const std::string name :
         {"octree", "literal", "dual", "plane-tree", "gauss", "cone-tree", "quadric"}) {
        CAPTURE(name);
        const SilhouetteMethodInfo& info = *find_silhouette_method(name);
        const std::unique_ptr<SilhouetteMethod> method = make_silhouette_method(name, mesh);
        std::vector<EdgeId> edges;
        TraversalCounters work;
        method->extract(as_taken_by(info, HomogeneousPoint::viewpoint({2.0f, 1.5f, 0.7f})), edges,
                        work);
        CHECK(work.edge_checks > edges.size());
        CHECK(work.edge_checks < mesh.edge_count() / 3);
        CHECK(work.box_checks > 0);
        CHECK(work.box_checks < mesh.face_count());
        CHECK(work.face_checks >= edges.size());

        // The second update is a small move.
        if (!info.has_update) continue;
        TraversalCounters first;
        TraversalCounters second;
        method->update(as_taken_by(info, HomogeneousPoint::viewpoint({2.0f, 1.5f, 0.7f})), edges,
                       first);
        method->update(as_taken_by(info, HomogeneousPoint::viewpoint({2.001f, 1.5f, 0.7f})), edges,
                       second);
        CHECK(second.face_checks < mesh.face_count() / 3);
        CHECK(second.edge_checks < edges.size());
    }
}

TEST_CASE("the methods that look at everything count everything") {
    const Mesh mesh(make_built_in_shape("terrain", 2000));
    for (const std::string name : {"brute", "brute-scalar", "edge-buffer"}) {
        CAPTURE(name);
        std::vector<EdgeId> edges;
        TraversalCounters work;
        work.face_checks = 7;  // The method must add to it.
        make_silhouette_method(name, mesh)
            ->extract(HomogeneousPoint::direction({1.0f, 0.2f, 0.3f}), edges, work);
        CHECK(work.face_checks == 7 + mesh.face_count());
        CHECK(work.edge_checks >= mesh.edges_of_class(EdgeClass::border).first);
        CHECK(work.box_checks == 0);
    }
}

}  // namespace
}  // namespace rimline
