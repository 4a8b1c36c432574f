#include "engine/frame/frame_view.h"

#include <doctest/doctest.h>

#include "engine/frame/silhouette_points.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

TEST_CASE("a frame view holds the bounds, the projection and the points of its scene") {
    const Mesh mesh(make_built_in_shape("knot", 400));
    const HoughOctree octree(mesh);
    const glm::dvec3 vertex(mesh.positions()[0]);
    Scene scene{.camera = {.eye = {0, 1, 5}}, .silhouette_camera = Camera{.eye = {3, 0, 4}}};
    scene.instances.push_back({.octree = &octree});
    scene.instances.push_back(
        {.octree = &octree, .translation = {2, 0, 0}, .has_lines = false, .casts_shadows = false});
    scene.lights.push_back({.vector = {1, 2, 1}});
    scene.lights.push_back({.vector = vertex, .directional = false});

    CasterMeshes casters;
    casters.try_emplace(&mesh, mesh);
    const FrameView view(scene, {300, 200}, casters);
    const SceneBounds bounds = bounds_of(scene);
    CHECK(view.bounds.center == bounds.center);
    CHECK(view.bounds.radius == bounds.radius);
    const Projection projection = make_projection(scene.camera, 1.5, bounds.center, bounds.radius);
    CHECK(view.projection.scale == projection.scale);
    CHECK(view.projection.z == projection.z);
    CHECK(view.projection.w == projection.w);
    CHECK(view.eye_from_world == camera_from_world(scene.camera));

    REQUIRE(view.instances.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const SceneInstance& instance = scene.instances[i];
        CHECK(view.instances[i].camera == camera_point(instance, scene.camera));
        REQUIRE(view.instances[i].lights.size() == 2);
        for (std::size_t l = 0; l < 2; ++l)
            CHECK(view.instances[i].lights[l].point ==
                  casting_point(scene, instance, scene.lights[l], casters));
    }
    CHECK(view.instances[0].lines == camera_point(scene.instances[0], *scene.silhouette_camera));
    CHECK_FALSE(view.instances[1].lines.has_value());
    // The point light lies on a vertex of the first instance, which casts shadows.
    CHECK_FALSE(view.instances[0].lights[0].is_moved);
    CHECK(view.instances[0].lights[1].is_moved);
    CHECK_FALSE(view.instances[1].lights[1].is_moved);
}

}  // namespace
}  // namespace rimline
