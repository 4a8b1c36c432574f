// Several origins: who owns what, and the two ways in which the naive rule loses edges.

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/origin_lists.h"
#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline {
namespace {

// Thesis 4.4.5 as written: a group's octree finds an edge from the face of its own that is inside the
// v-sphere, unless the edge is SFO from the group's origin; edges that are SFO from both faces' groups
// are tested explicitly.
class NaiveRule {
public:
    explicit NaiveRule(const HoughOctree& octree)
        : mesh_(octree.mesh()), origins_(octree.origins()), groups_(octree.face_groups()) {}

    struct Verdict {
        bool is_found;
        bool was_inside;  // Some face lies inside the v-sphere of its own group.
    };
    Verdict look_for(EdgeId edge, const HomogeneousPoint& p) const {
        const std::array<FaceId, 2>& faces = mesh_.edge(edge).faces;
        Verdict verdict{false, false};
        bool is_sfo_from_both = true;
        for (std::size_t i = 0; i < 2; ++i) {
            const glm::dvec3& origin = origins_[groups_[index(faces[i])]];
            const bool is_sfo = side(faces[0], origin) != side(faces[1], origin);
            is_sfo_from_both = is_sfo_from_both && is_sfo;
            if (!is_inside(faces[i], origin, p)) continue;
            verdict.was_inside = true;
            if (!is_sfo && !is_inside(faces[1 - i], origin, p)) verdict.is_found = true;
        }
        verdict.is_found = verdict.is_found || is_sfo_from_both;
        return verdict;
    }

private:
    int side(FaceId face, const glm::dvec3& origin) const {
        return hough_point(mesh_.plane(face), origin).side;
    }
    // A face with dO > 0 is front inside the v-sphere, with dO < 0 outside.
    bool is_inside(FaceId face, const glm::dvec3& origin, const HomogeneousPoint& p) const {
        return is_front(mesh_.plane(face), p) == (side(face, origin) > 0);
    }

    const Mesh& mesh_;
    std::span<const glm::dvec3> origins_;
    std::vector<std::uint32_t> groups_;
};

TEST_CASE("edges that the naive rule loses in either way are found") {
    std::uint64_t lost_inside_but_sfo = 0;
    std::uint64_t lost_never_inside = 0;
    // Coarse shapes have sharp edges, which grouping does not count.
    for (const auto& [shape, faces] : {std::pair<std::string_view, std::uint32_t>{"knot", 6000},
                                       {"torus", 6000},
                                       {"spring", 400},
                                       {"scene", 2000}}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, faces));
        const double r = mesh.radius();
        const glm::dvec3 c = mesh.center();
        const HoughOctree octree(mesh, {{c, c + glm::dvec3(0.5 * r, 0.1 * r, 0.4 * r),
                                         c - glm::dvec3(0.3 * r, 0.7 * r, 0.2 * r)}});
        const NaiveRule naive(octree);
        tests::ProbePoints probes(mesh, 81);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const HomogeneousPoint p = probes.next();
            std::vector<EdgeId> found;
            TraversalCounters counters;
            octree.extract(p, found, counters);
            std::sort(found.begin(), found.end());
            const std::vector<EdgeId> truth = brute_force_silhouette(mesh, p);
            REQUIRE(found == truth);
            for (const EdgeId edge : truth) {
                if (mesh.edge_class(edge) != EdgeClass::regular) continue;
                const NaiveRule::Verdict verdict = naive.look_for(edge, p);
                lost_inside_but_sfo += !verdict.is_found && verdict.was_inside;
                lost_never_inside += !verdict.is_found && !verdict.was_inside;
            }
        }
    }
    MESSAGE(lost_inside_but_sfo << " lost because the inside face's group sees them as SFO, "
                                << lost_never_inside << " because no group sees a face inside");
    CHECK(lost_inside_but_sfo > 100);
    CHECK(lost_never_inside > 100);
}

TEST_CASE("faces and edges are counted once whatever the origins") {
    for (const auto& [name, source] : tests::made_meshes(1000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        for (const auto& origins : tests::origin_lists(mesh)) {
            CAPTURE(origins.size());
            const HoughOctree octree(mesh, {origins});
            const HoughOctreeStatistics& s = octree.statistics();
            CHECK(s.group_faces.size() == origins.size());
            CHECK(std::accumulate(s.group_faces.begin(), s.group_faces.end(), 0u) == s.faces);
            CHECK(s.faces == mesh.face_count() - mesh.degenerate_face_count());
            CHECK(s.owned_edges + s.sfo_edges + s.undecided_edges + s.nonmanifold_edges ==
                  mesh.edges_of_class(EdgeClass::border).first);
            const std::vector<std::uint32_t> groups = octree.face_groups();
            for (std::uint32_t g = 0; g < origins.size(); ++g)
                CHECK(std::count(groups.begin(), groups.end(), g) == s.group_faces[g]);
        }
    }
}

TEST_CASE("a face belongs to the origin with fewest flat SFO edges, then to the farthest") {
    const Mesh mesh(make_built_in_shape("spring", 4000));
    const std::vector<glm::dvec3> origins{mesh.center(),
                                          mesh.center() + glm::dvec3(0.8, 0.2, -0.5)};
    const std::vector<std::uint32_t> groups = HoughOctree(mesh, {origins}).face_groups();
    const auto sfo_count = [&](FaceId face, const glm::dvec3& origin) {
        std::uint32_t count = 0;
        for (const EdgeId edge : mesh.edges_of(face)) {
            if (mesh.edge_class(edge) != EdgeClass::regular) continue;
            const std::array<FaceId, 2>& faces = mesh.edge(edge).faces;
            const Plane& a = mesh.plane(faces[0]);
            const Plane& b = mesh.plane(faces[1]);
            if (a.nx * b.nx + a.ny * b.ny + a.nz * b.nz > 0.0f)
                count += hough_point(a, origin).side != hough_point(b, origin).side;
        }
        return count;
    };
    std::uint32_t by_count = 0;
    std::uint32_t by_distance = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t own = groups[f];
        const std::uint32_t own_count = sfo_count(FaceId{f}, origins[own]);
        const std::uint32_t other_count = sfo_count(FaceId{f}, origins[1 - own]);
        REQUIRE(own_count <= other_count);
        by_count += own_count < other_count;
        if (own_count != other_count) continue;
        ++by_distance;
        const auto distance = [&](std::uint32_t g) {
            return glm::length(hough_point(mesh.plane(FaceId{f}), origins[g]).position);
        };
        REQUIRE(distance(own) >= distance(1 - own));
    }
    CHECK(by_count > 10);
    CHECK(by_distance > 1000);
}

TEST_CASE("more origins leave fewer SFO edges") {
    const Mesh mesh(make_built_in_shape("spring", 20000));
    const glm::dvec3 c = mesh.center();
    const double r = mesh.radius();
    const HoughOctree one(mesh);
    const HoughOctree four(mesh, {{c, c + glm::dvec3(r, 0.0, 0.0), c + glm::dvec3(0.0, r, 0.0),
                                   c + glm::dvec3(0.0, 0.0, r)}});
    CHECK(four.statistics().sfo_edges < one.statistics().sfo_edges / 2);
    CHECK(four.statistics().ghost_edges > 0);
}

}  // namespace
}  // namespace rimline
