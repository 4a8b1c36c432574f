#include "engine/frame/instance_states.h"

#include <memory>
#include <utility>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

Scene kept_scene(const Mesh& mesh, const HoughOctree& octree, Style style) {
    Scene scene{.camera = fit_camera({}, mesh, default_view_direction({0, 1, 0}), 1.0),
                .style = style};
    scene.instances.push_back({.octree = &octree});
    scene.lights.push_back(default_sun(scene.camera));
    return scene;
}

TEST_CASE("instances and lights that stay keep their trackers when others come and go") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("torus", 1000));
    const HoughOctree octree(mesh);
    const Mesh other(make_built_in_shape("box", 12));
    const HoughOctree other_octree(other);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = kept_scene(mesh, octree, Style::ink);
    renderer.render(scene, 64, 64);
    const VkDeviceAddress kept = renderer.silhouette(0, 0)->slots.address;
    const std::uint64_t full = renderer.report().bytes_full;

    scene.instances.push_back({.octree = &other_octree});
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(0, 0)->slots.address == kept);
    CHECK(renderer.report().bytes_streamed == renderer.report().bytes_full - full);

    scene.lights.push_back({.vector = {0, 1, 0}, .directional = true});
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(0, 0)->slots.address == kept);

    scene.lights.pop_back();
    scene.instances.pop_back();
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(0, 0)->slots.address == kept);
    CHECK(renderer.report().bytes_streamed == 0);

    // At another index too, as where others are culled.
    scene.instances.insert(scene.instances.begin(), 2, {.octree = &other_octree});
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(2, 0)->slots.address == kept);
    const VkDeviceAddress second = renderer.silhouette(1, 0)->slots.address;
    CHECK(renderer.silhouette(0, 0)->slots.address != second);
    std::swap(scene.instances[0], scene.instances[2]);
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(0, 0)->slots.address == kept);
    CHECK(renderer.silhouette(1, 0)->slots.address == second);
    CHECK(renderer.report().bytes_streamed == 0);
    scene.instances.pop_back();
    scene.instances.erase(scene.instances.begin());
    renderer.render(scene, 64, 64);
    CHECK(renderer.silhouette(0, 0)->slots.address == second);
    CHECK(renderer.report().bytes_streamed == 0);
    CHECK(renderer.report().meshes_uploaded == 0);
}

TEST_CASE("meshes that a scene keeps stay on the device, until a scene does not") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model first(make_built_in_shape("torus", 1000));
    const tests::Model second(make_built_in_shape("box", 12));
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const auto uploads = [&](const tests::Model& shown, std::vector<const HoughOctree*> kept) {
        Scene scene = kept_scene(shown.mesh, shown.octree, Style::ink);
        scene.kept = std::move(kept);
        renderer.render(scene, 64, 64);
        return renderer.report().meshes_uploaded;
    };
    CHECK(uploads(first, {}) == 1);
    CHECK(uploads(second, {&first.octree}) == 1);
    CHECK(uploads(first, {&second.octree}) == 0);
    CHECK(uploads(second, {&first.octree}) == 0);
    // The same instances, and nothing else any more.
    CHECK(uploads(second, {}) == 0);
    CHECK(uploads(first, {}) == 1);
    CHECK(uploads(second, {}) == 1);
}

TEST_CASE("buffers of a silhouette are those of the frame recorded last, or none") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("torus", 1000));
    const HoughOctree octree(mesh);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = kept_scene(mesh, octree, Style::ink);
    CHECK_FALSE(renderer.silhouette(0, std::nullopt));
    renderer.render(scene, 32, 32);
    CHECK(renderer.silhouette(0, std::nullopt)->slots.buffer != VK_NULL_HANDLE);
    CHECK(renderer.silhouette(0, 0)->arguments.buffer != VK_NULL_HANDLE);
    CHECK_FALSE(renderer.silhouette(0, 1));
    CHECK_FALSE(renderer.silhouette(1, std::nullopt));
    scene.lines = false;
    renderer.render(scene, 32, 32);
    CHECK_FALSE(renderer.silhouette(0, std::nullopt));
    CHECK(renderer.silhouette(0, 0));
    scene.shadows = false;
    renderer.render(scene, 32, 32);
    CHECK_FALSE(renderer.silhouette(0, 0));
    // Those that the GPU finds.
    if (!gpu->context().round_to_nearest_float32) return;
    scene.lines = scene.shadows = true;
    scene.instances[0].octree = nullptr;
    scene.instances[0].deforming = &mesh;
    renderer.render(scene, 32, 32);
    CHECK(renderer.silhouette(0, std::nullopt)->face_words.address != 0);
    CHECK(renderer.silhouette(0, 0)->slots.address !=
          renderer.silhouette(0, std::nullopt)->slots.address);
}

TEST_CASE("a light that casts no shadow takes no silhouette, of a mesh that deforms neither") {
    RIMLINE_OPEN_GPU(gpu);
    if (!gpu->context().round_to_nearest_float32) RIMLINE_SKIP("the device has no RoundingModeRTE");
    const Mesh mesh(make_built_in_shape("torus", 1000));
    const HoughOctree octree(mesh);
    const auto bytes_with = [&](const SceneInstance& instance, std::vector<bool> casting) {
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        Scene scene = kept_scene(mesh, octree, Style::ink);
        scene.instances = {instance};
        const Light sun = scene.lights[0];
        scene.lights.clear();
        for (const bool casts : casting) {
            scene.lights.push_back(sun);
            scene.lights.back().casts_shadows = casts;
        }
        renderer.render(scene, 32, 32);
        return renderer.stream_bytes();
    };
    for (const SceneInstance& instance :
         {SceneInstance{.octree = &octree}, SceneInstance{.deforming = &mesh}}) {
        CAPTURE(instance.deforming != nullptr);
        const std::uint64_t none = bytes_with(instance, {});
        CHECK(bytes_with(instance, {false, false}) == none);
        const std::uint64_t one = bytes_with(instance, {true});
        CHECK(one > none);
        CHECK(bytes_with(instance, {false, true}) == one);
    }
}

TEST_CASE("a mesh may go when a scene without it is drawn, and another have its address") {
    RIMLINE_OPEN_GPU(gpu);
    const auto model_of = [](const char* shape) {
        return std::make_unique<tests::Model>(make_built_in_shape(shape, 1000));
    };
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    std::unique_ptr<tests::Model> model = model_of("torus");
    Scene scene = kept_scene(model->mesh, model->octree, Style::toon);
    renderer.submit(scene, 64, 64);
    scene.instances.clear();
    renderer.submit(scene, 64, 64);  // While the GPU draws it.
    model.reset();
    renderer.finish();
    renderer.finish();
    CHECK(renderer.tracker_bytes() == 0);
    model = model_of("knot");
    const Scene other = kept_scene(model->mesh, model->octree, Style::toon);
    CHECK(renderer.render(other, 64, 64).rgba ==
          Renderer(gpu->context(), {.samples = 1, .scale = 1}).render(other, 64, 64).rgba);
}

}  // namespace
}  // namespace rimline
