#include "silhouette/methods/literal/literal_octree.h"

#include <doctest/doctest.h>

#include <numeric>
#include <type_traits>

#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/methods/literal/literal_extraction.h"

namespace rimline {
namespace {

static_assert(!std::is_constructible_v<LiteralOctree, Mesh>);

TEST_CASE("the literal extraction equals brute force on every made mesh") {
    for (const auto& [name, source] : tests::made_meshes(3000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        tests::check_literal_extraction(mesh, LiteralOctree(mesh), 500, 101);
    }
}

TEST_CASE("the literal extraction is right from every origin and with every size of leaf") {
    for (const auto& [name, source] : tests::made_meshes(600)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const double r = mesh.radius();
        for (const glm::dvec3& origin :
             {glm::dvec3(0.0), mesh.center() + glm::dvec3(r, 0.1 * r, 0.0)})
            for (const PointOctreeOptions& octree :
                 {PointOctreeOptions{1, 48}, PointOctreeOptions{9, 48}, PointOctreeOptions{1, 3}})
                for (const std::uint32_t small_leaf : {0u, 2u}) {
                    LiteralOctreeOptions options;
                    options.origin = origin;
                    options.octree = octree;
                    options.small_leaf = small_leaf;
                    CAPTURE(octree.bucket_size);
                    CAPTURE(octree.max_depth);
                    tests::check_literal_extraction(mesh, LiteralOctree(mesh, options), 40, 102);
                }
    }
}

TEST_CASE("every edge is in the tree or listed apart") {
    for (const auto& [name, source] : tests::made_meshes(2000)) {
        CAPTURE(name);
        const Mesh mesh(source);
        const LiteralOctree octree(mesh);
        const LiteralOctreeStatistics& s = octree.statistics();
        CHECK(s.faces == mesh.face_count() - mesh.degenerate_face_count());
        CHECK(s.tree_edges + s.sfo_edges + s.undecided_edges + s.nonmanifold_edges ==
              mesh.edges_of_class(EdgeClass::border).first);
        const std::vector<std::uint32_t> histogram = leaf_depth_histogram(octree.nodes());
        CHECK(std::accumulate(histogram.begin(), histogram.end(), 0u) == s.leaves);
        CHECK(histogram.size() == (s.leaves > 0 ? s.depth + 1 : 0));
        CHECK(s.depth <= 48);
    }
}

TEST_CASE("the SFO edges are the silhouette from the origin, where no plane holds it") {
    const Mesh mesh(make_built_in_shape("torus", 3000));
    LiteralOctreeOptions options;
    options.origin = glm::dvec3(0.1, 0.2, 0.3);
    const LiteralOctree octree(mesh, options);
    CHECK(octree.statistics().undecided_edges == 0);
    CHECK(octree.statistics().sfo_edges ==
          brute_force_silhouette(mesh, HomogeneousPoint::viewpoint({0.1f, 0.2f, 0.3f})).size());
    CHECK(octree.statistics().sfo_edges > 0);
}

TEST_CASE("boxes hold what they stand for") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const LiteralOctree octree(mesh);
    std::vector<std::uint32_t> position_of(mesh.face_count());
    for (std::uint32_t i = 0; i < octree.faces().size(); ++i)
        position_of[index(octree.faces()[i])] = i;
    const auto holds = [](const HoughBox& box, const glm::dvec3& point) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double p = point[static_cast<int>(axis)];
            if (p < double{box.low[axis]} || p > double{box.high[axis]}) return false;
        }
        return true;
    };
    std::uint32_t ghosts = 0;
    for (std::size_t n = 0; n < octree.nodes().size(); ++n) {
        const OctreeNode& node = octree.nodes()[n];
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            REQUIRE(holds(octree.point_boxes()[n].box, octree.hough_points()[i]));
            REQUIRE(holds(octree.edge_boxes()[n].box, octree.hough_points()[i]));
            for (const EdgeId edge : mesh.edges_of(octree.faces()[i]))
                for (const FaceId face : mesh.edge(edge).faces) {
                    const std::uint32_t other = position_of[index(face)];
                    if (octree.sides()[other] != octree.sides()[i]) continue;  // SFO.
                    REQUIRE(holds(octree.edge_boxes()[n].box, octree.hough_points()[other]));
                    ghosts += !holds(octree.point_boxes()[n].box, octree.hough_points()[other]);
                }
        }
    }
    CHECK(ghosts > mesh.face_count());
}

// Figure 3.8: as the mesh grows, boxes grow like the silhouette, not like the mesh.
TEST_CASE("box checks of an extraction grow as the silhouette does") {
    std::array<double, 2> boxes_an_edge{};
    std::array<double, 2> boxes_a_face{};
    for (std::size_t i = 0; i < 2; ++i) {
        const Mesh mesh(make_built_in_shape("knot", i == 0 ? 4000 : 64000));
        const LiteralOctree octree(mesh);
        const Orbit orbit(mesh.center(), {0.0, 1.0, 0.0}, 2.0 * mesh.radius());
        LiteralCounters counters;
        std::size_t found = 0;
        for (int k = 0; k < 10; ++k) {
            std::vector<EdgeId> edges;
            octree.extract(orbit.viewpoint(0.6 * k), edges, counters);
            found += edges.size();
        }
        const auto boxes = static_cast<double>(counters.box_checks());
        boxes_an_edge[i] = boxes / static_cast<double>(found);
        boxes_a_face[i] = boxes / 10.0 / mesh.face_count();
    }
    CHECK(boxes_an_edge[1] < 1.5 * boxes_an_edge[0]);
    CHECK(boxes_a_face[1] < 0.5 * boxes_a_face[0]);
}

TEST_CASE("counters are added to, and tell PBVs from EBVs") {
    const Mesh mesh(make_built_in_shape("torus", 4000));
    LiteralOctreeOptions every_box;
    every_box.small_leaf = 0;
    const LiteralOctree octree(mesh);
    const LiteralOctree with_leaf_boxes(mesh, every_box);
    const HomogeneousPoint p = HomogeneousPoint::viewpoint({3.0f, 2.0f, 1.0f});
    std::vector<EdgeId> edges;
    LiteralCounters once;
    octree.extract(p, edges, once);
    CHECK(once.pbv_checks >
          once.ebv_checks);  // An EBV is tested only where the PBV is not outside.
    CHECK(once.ebv_checks > 0);
    CHECK(once.obv_checks == 0);
    CHECK(once.box_checks() == once.pbv_checks + once.ebv_checks);
    CHECK(once.edge_tests >= edges.size());
    CHECK(once.face_checks < mesh.face_count());
    LiteralCounters twice = once;
    octree.extract(p, edges, twice);
    CHECK(twice.box_checks() == 2 * once.box_checks());
    CHECK(twice.face_checks == 2 * once.face_checks);
    LiteralCounters more_boxes;
    with_leaf_boxes.extract(p, edges, more_boxes);
    CHECK(more_boxes.box_checks() > once.box_checks());
    CHECK(more_boxes.face_checks < once.face_checks);
}

}  // namespace
}  // namespace rimline
