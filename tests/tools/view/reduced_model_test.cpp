#include "tools/view/reduced_model.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

TEST_CASE("a reduced model has few faces in the bounds of its model, and stands in for it") {
    const Mesh mesh(make_built_in_shape("torus", 60'000));
    REQUIRE(ReducedModel::is_worth_it(mesh));
    const ReducedModel reduced(mesh);
    CHECK(reduced.mesh().face_count() <= ReducedModel::k_faces);
    CHECK(reduced.mesh().face_count() > ReducedModel::k_faces / 2);
    CHECK(glm::distance(reduced.mesh().center(), mesh.center()) < 1e-3 * mesh.radius());
    CHECK(reduced.mesh().radius() == doctest::Approx(mesh.radius()).epsilon(1e-3));
    const HoughOctree octree(mesh);
    SceneInstance instance{.octree = &octree, .name = "torus"};
    reduced.stand_in(instance);
    CHECK(&instance.mesh() == &reduced.mesh());
    CHECK(instance.name == "torus");
    CHECK(instance.is_solid == is_solid(reduced.mesh()));
}

TEST_CASE("a model of few faces, or with pictures on them, is not reduced") {
    CHECK_FALSE(ReducedModel::is_worth_it(Mesh(make_built_in_shape("torus", 30'000))));
    MeshSource source = make_built_in_shape("torus", 60'000);
    source.materials.materials = {{glm::vec3(1.0f), TextureId{0}}};
    source.materials.of_face.assign(source.triangles.size(), MaterialId{0});
    source.materials.corner_uvs.assign(3 * source.triangles.size(), glm::vec2(0.5f));
    source.materials.textures = {{.place = "a texture"}};
    CHECK(ReducedModel::is_worth_it(Mesh(source)));  // It cannot be read.
    source.materials.textures[0].picture =
        std::make_shared<const Picture>(Picture{.width = 1, .height = 1, .rgba = {1, 2, 3, 255}});
    CHECK_FALSE(ReducedModel::is_worth_it(Mesh(source)));
}

}  // namespace
