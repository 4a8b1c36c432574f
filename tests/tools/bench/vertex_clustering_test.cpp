#include "tools/bench/vertex_clustering.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;

TEST_CASE(
    "a clustered mesh has at most the requested number of faces and few less, within the bounds") {
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    for (const std::uint32_t faces : {300u, 1000u, 4000u, 15'000u}) {
        CAPTURE(faces);
        const Mesh coarse(tools::cluster_vertices(mesh, faces));
        CHECK(coarse.face_count() <= faces);
        CHECK(coarse.face_count() > faces / 2);
        CHECK(coarse.degenerate_face_count() < coarse.face_count() / 100);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(coarse.bounds().low[axis] >= mesh.bounds().low[axis]);
            CHECK(coarse.bounds().high[axis] <= mesh.bounds().high[axis]);
        }
    }
}

TEST_CASE("faces of a clustered sphere still look outward") {
    const Mesh mesh(make_built_in_shape("sphere", 20'000));
    const Mesh coarse(tools::cluster_vertices(mesh, 500));
    REQUIRE(coarse.face_count() > 250);
    CHECK(coarse.is_closed());
    for (const Plane& plane : coarse.planes()) CHECK(plane.d > 0.0f);
}

TEST_CASE("clustering leaves a mesh that is small enough as it is, and empty or flat ones empty") {
    const Mesh mesh(make_built_in_shape("torus", 800));
    const MeshSource same = tools::cluster_vertices(mesh, mesh.face_count());
    CHECK(same.triangles.size() == mesh.face_count());
    CHECK(same.positions.size() == mesh.vertex_count());

    CHECK(tools::cluster_vertices(mesh, 0).triangles.empty());
    CHECK(tools::cluster_vertices(Mesh(MeshSource{}), 10).triangles.empty());
    MeshSource point;
    point.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    point.triangles = {{0, 1, 2}};
    CHECK(tools::cluster_vertices(Mesh(point), 10).triangles.empty());
}
