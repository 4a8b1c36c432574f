#include "silhouette/field/unit_planes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

TEST_CASE("the planes pass through their faces' corners in unit coordinates") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const UnitPlanes planes(mesh);
    REQUIRE(planes.size() == mesh.face_count());
    double area = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        CHECK(glm::length(planes.normal(i)) == doctest::Approx(1.0).epsilon(1e-14));
        for (const VertexId corner : mesh.triangles()[index(planes.face(i))]) {
            const glm::dvec3 p =
                planes.frame().from_model(glm::dvec3(mesh.positions()[index(corner)]));
            CHECK(std::abs(planes.distance(i, p)) < 1e-6);
            CHECK(glm::length(p) <= 1.0 + 1e-12);
        }
        area += planes.area(i);
    }
    CHECK(area > 0.0);
}

TEST_CASE("areas of a box sum to its surface") {
    const UnitPlanes planes(Mesh(make_built_in_shape("box", 12)));
    double area = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) area += planes.area(i);
    const double side = 2.0 / std::sqrt(3.0);
    CHECK(area == doctest::Approx(6.0 * side * side));
}

TEST_CASE("moving and scaling a mesh leaves its unit planes") {
    const MeshSource source = tests::octahedron();
    const UnitPlanes planes{Mesh(source)};
    for (const auto& [scale, shift] :
         {std::pair{0x1p-40f, 0.0f}, {0x1p40f, 0.0f}, {1.0f, 4096.0f}, {0x1p20f, 0x1p30f}}) {
        MeshSource moved = source;
        for (glm::vec3& p : moved.positions) p = p * scale + glm::vec3(shift);
        const UnitPlanes other{Mesh(moved)};
        REQUIRE(other.size() == planes.size());
        for (std::size_t i = 0; i < planes.size(); ++i) {
            CHECK(glm::distance(other.normal(i), planes.normal(i)) < 1e-7);
            CHECK(other.offset(i) == doctest::Approx(planes.offset(i)));
            CHECK(other.area(i) == doctest::Approx(planes.area(i)));
        }
    }
}

TEST_CASE("faces without a plane are left out and a list of faces keeps the mesh's frame") {
    MeshSource source = tests::octahedron();
    source.triangles.push_back({0, 0, 1});
    const Mesh mesh(source);
    const UnitPlanes all(mesh);
    CHECK(all.size() == 8);
    const std::vector<FaceId> some = {FaceId{3}, FaceId{8}};
    const UnitPlanes one(mesh, some);
    REQUIRE(one.size() == 1);
    CHECK(one.face(0) == FaceId{3});
    CHECK(one.normal(0) == all.normal(3));
    CHECK(one.frame().radius == all.frame().radius);
    const UnitPlanes none{Mesh(MeshSource{})};
    CHECK(none.size() == 0);
    CHECK(none.frame().radius == 1.0);
}

}  // namespace
}  // namespace rimline
