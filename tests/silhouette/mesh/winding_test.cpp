#include "silhouette/mesh/winding.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

MeshSource moved(MeshSource source, const glm::vec3& by) {
    for (glm::vec3& position : source.positions) position += by;
    return source;
}

TEST_CASE("the enclosed volume of a tetrahedron and an octahedron is known wherever they are") {
    for (const glm::vec3 by : {glm::vec3(0), glm::vec3(8, -4, 2)}) {
        CHECK(enclosed_volume(Mesh(moved(tetrahedron(), by))) == doctest::Approx(8.0 / 3.0));
        CHECK(enclosed_volume(Mesh(moved(octahedron(), by))) == doctest::Approx(4.0 / 3.0));
    }
}

TEST_CASE("a closed mesh is inside out exactly when it is wound the other way") {
    for (const char* name : {"sphere", "knot", "box", "torus"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name));
        REQUIRE(mesh.is_closed());
        CHECK_FALSE(is_inside_out(mesh));
        const Mesh turned = turned_inside_out(mesh);
        CHECK(is_inside_out(turned));
        CHECK(enclosed_volume(turned) == doctest::Approx(-enclosed_volume(mesh)));
        REQUIRE(turned.face_count() == mesh.face_count());
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            CHECK(turned.plane(FaceId{f}).nx == doctest::Approx(-mesh.plane(FaceId{f}).nx));
        CHECK_FALSE(is_inside_out(turned_inside_out(turned)));
    }
}

TEST_CASE("nobody says of an open or an empty mesh that it is inside out") {
    CHECK_FALSE(is_inside_out(Mesh(MeshSource{})));
    CHECK_FALSE(is_inside_out(Mesh(book(1))));
    MeshSource open = tetrahedron();
    for (auto& triangle : open.triangles) std::swap(triangle[0], triangle[1]);
    CHECK(is_inside_out(Mesh(open)));
    open.triangles.pop_back();
    CHECK_FALSE(is_inside_out(Mesh(open)));
}

}  // namespace
