#include "tools/bench/transform_octree.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/methods/literal/literal_tracker.h"
#include "tools/options/track_path.h"

using namespace rimline;
using tools::NodeBoxes;
using tools::PlaneTransform;
using tools::TransformOctree;

namespace {

constexpr PlaneTransform k_transforms[] = {PlaneTransform::hough, PlaneTransform::dual};
constexpr NodeBoxes k_kinds[] = {NodeBoxes::tight, NodeBoxes::octants};

// The first move that leaves a bit wrong, or the path's length.
std::size_t first_wrong_move(const Mesh& mesh, const TransformOctree& octree,
                             const std::vector<HomogeneousPoint>& path) {
    std::vector<std::uint32_t> words = brute_force_face_bits(mesh, path[0]);
    for (std::size_t i = 1; i < path.size(); ++i) {
        octree.move(path[i - 1], path[i], words);
        if (words != brute_force_face_bits(mesh, path[i])) return i;
    }
    return path.size();
}

}  // namespace

TEST_CASE("either transform with either kind of boxes turns exactly the faces that turn") {
    for (const char* shape : {"knot", "box", "scene", "terrain"}) {
        const Mesh mesh(make_built_in_shape(shape, 600));
        const std::vector<HomogeneousPoint> path = tools::random_path(mesh, 5, 300);
        // The box's center lies in no plane; its corner, in three.
        for (const glm::dvec3& origin : {mesh.center(), glm::dvec3(mesh.positions()[0])})
            for (const PlaneTransform transform : k_transforms)
                for (const NodeBoxes kind : k_kinds) {
                    CAPTURE(std::string(shape));
                    CAPTURE(static_cast<int>(transform));
                    CAPTURE(static_cast<int>(kind));
                    const TransformOctree octree(mesh, origin, transform, kind);
                    CHECK(first_wrong_move(mesh, octree, path) == path.size());
                }
    }
}

TEST_CASE("in Hough space with tight boxes it does the work of the literal full traversal") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const LiteralOctree literal(mesh);
    const std::vector<HomogeneousPoint> path = tools::orbit_path(mesh, {0, 1, 0}, 2.0, 3.0, 40);
    LiteralTracker tracker(literal, path[0], {LiteralUpdate::full_traversal});
    const TransformOctree octree(mesh, literal.origin(), PlaneTransform::hough, NodeBoxes::tight);
    std::vector<std::uint32_t> words = brute_force_face_bits(mesh, path[0]);
    for (std::size_t i = 1; i < path.size(); ++i) {
        const LiteralCounters expected = tracker.move_to(path[i]);
        const LiteralCounters counted = octree.move(path[i - 1], path[i], words);
        CHECK(counted.pbv_checks == expected.pbv_checks);
        CHECK(counted.face_checks == expected.face_checks);
        CHECK(counted.contained_faces == expected.contained_faces);
        CHECK(counted.obv_checks == 0);
    }
}

TEST_CASE(
    "dual points are Hough points inverted in the unit sphere, but for planes that hold the "
    "origin") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const glm::dvec3 corner(mesh.positions()[0]);
    const TransformOctree at_corner(mesh, corner, PlaneTransform::dual, NodeBoxes::tight);
    CHECK(at_corner.faces_at_infinity() == 6);
    CHECK(at_corner.points().size() == 6);

    const TransformOctree hough(mesh, mesh.center(), PlaneTransform::hough, NodeBoxes::tight);
    const TransformOctree dual(mesh, mesh.center(), PlaneTransform::dual, NodeBoxes::tight);
    REQUIRE(dual.points().size() == 12);
    for (const glm::dvec3& d : dual.points()) {
        bool found = false;
        for (const glm::dvec3& h : hough.points())
            found = found || glm::length(h / glm::dot(h, h) - d) < 1e-6;
        CHECK(found);
    }
}

TEST_CASE("an octree over nothing turns nothing") {
    const Mesh mesh{MeshSource{}};
    const TransformOctree octree(mesh, {0, 0, 0}, PlaneTransform::dual, NodeBoxes::octants);
    std::vector<std::uint32_t> words;
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({1, 2, 3});
    CHECK(octree.move(point, point, words).box_checks() == 0);
}
