// All line paths against each other: the same capsules whatever makes them, so the same pixels, or pixels within the
// bound of the device (support/line_path_bound.h).

#include "engine/line_path.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

#include "engine/frame/draw_data.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/line_pass.h"
#include "engine/picture_lines.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/line_path_bound.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_line_path_size = 256;

// Lines alone, hidden ones and creases among them.
Scene line_scene(const Model& model, bool orthographic) {
    const glm::dvec3 up(0, 1, 0);
    Scene scene{.camera = fit_camera(
                    {.up = up, .ortho_height = orthographic ? 2.2 * model.mesh.radius() : 0.0},
                    model.mesh, default_view_direction(up), 1.0),
                .palette = {.background = glm::vec3(1.0f),
                            .ink = glm::vec3(0.0f),
                            .shade = glm::vec3(1.0f)},
                .shadows = false,
                .hidden_line_strength = 0.5f,
                .crease_angle_deg = 30.0f};
    scene.instances.push_back({.octree = &model.octree});
    return scene;
}

Picture draw(const Gpu& gpu, const Scene& scene, LinePath path) {
    Renderer renderer(gpu.context(), {.samples = 1, .scale = 1, .line_path = path});
    return renderer.render(scene, k_line_path_size, k_line_path_size);
}

std::size_t differing_pixels(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        differing += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]) ? 0u : 1u;
    return differing;
}

std::size_t inked_pixels(const Picture& picture) {
    std::size_t inked = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) inked += picture.rgba[i] < 200;
    return inked;
}

// Triangles between random points of a small grid: edges of every class, faces of every orientation.
MeshSource random_soup(unsigned seed) {
    std::mt19937 random(seed);
    const auto coordinate = [&] { return static_cast<float>(random() % 4) - 1.5f; };
    MeshSource soup;
    for (int i = 0; i < 24; ++i)
        soup.positions.emplace_back(coordinate(), coordinate(), coordinate());
    for (int i = 0; i < 60; ++i) {
        const auto corner = [&] { return static_cast<std::uint32_t>(random() % 24); };
        soup.triangles.push_back({corner(), corner(), corner()});
    }
    return soup;
}

void check_paths(const Gpu& gpu, const std::string& name, const Model& model) {
    const LinePathBound bound = line_path_bound(gpu.context().driver);
    for (const bool orthographic : {false, true}) {
        const Scene scene = line_scene(model, orthographic);
        const Picture expected = draw(gpu, scene, LinePath::geometry);
        CAPTURE(name);
        CAPTURE(orthographic);
        CHECK(inked_pixels(expected) > 300);
        for (const LinePath path :
             {LinePath::pulling, LinePath::all_edges, LinePath::quads, LinePath::adjacency}) {
            if (needs_geometry_shader(path) && !gpu.context().features.geometry_shader) continue;
            const Picture picture = draw(gpu, scene, path);
            CAPTURE(static_cast<int>(path));
            CAPTURE(differing_pixels(expected, picture));
            CHECK(differ_within(expected, picture, bound));
        }
    }
}

TEST_CASE(
    "on lavapipe pictures of line paths must be equal, elsewhere within a bound that errors "
    "exceed") {
    const LinePathBound exact = line_path_bound(VK_DRIVER_ID_MESA_LLVMPIPE);
    const LinePathBound loose = line_path_bound(VK_DRIVER_ID_NVIDIA_PROPRIETARY);
    Picture picture{100, 100, std::vector<std::uint8_t>(4 * 100 * 100, 128)};
    const Picture before = picture;
    CHECK(differ_within(before, picture, exact));
    ++picture.rgba[40];
    CHECK_FALSE(differ_within(before, picture, exact));
    CHECK(differ_within(before, picture, loose));
    // Ten pixels of ten thousand may turn, and an eleventh may not.
    for (std::size_t i = 0; i < 10; ++i) picture.rgba[4 * 97 * i] = 255;
    CHECK(differ_within(before, picture, loose));
    picture.rgba[4 * 5000] = 255;
    CHECK_FALSE(differ_within(before, picture, loose));
    // Small differences everywhere are no rounding.
    picture = before;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 16) ++picture.rgba[i];
    CHECK_FALSE(differ_within(before, picture, loose));
    CHECK_FALSE(differ_within(before, Picture{100, 99, {}}, loose));
}

TEST_CASE("the bound of line paths finds a line that is missing thin or elsewhere" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const LinePathBound bound = line_path_bound(VK_DRIVER_ID_NVIDIA_PROPRIETARY);
    const Model model(make_built_in_shape("knot"));
    const Scene scene = line_scene(model, false);
    const Picture expected = draw(*gpu, scene, LinePath::pulling);
    Scene changed = scene;
    changed.line_width_px *= 1.01f;
    CHECK_FALSE(differ_within(expected, draw(*gpu, changed, LinePath::pulling), bound));
    changed = scene;
    changed.hidden_line_strength = 0.45f;
    CHECK_FALSE(differ_within(expected, draw(*gpu, changed, LinePath::pulling), bound));
    changed = scene;
    changed.instances[0].translation.x += 0.001 * model.mesh.radius();
    CHECK_FALSE(differ_within(expected, draw(*gpu, changed, LinePath::pulling), bound));
}

TEST_CASE("every line path gives the same pixels" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const char* name : {"knot", "spring", "terrain", "scene", "box"})
        check_paths(*gpu, name, Model(make_built_in_shape(name)));
}

TEST_CASE("every line path gives the same pixels of a soup of triangles" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Model model(random_soup(seed));
        for (const EdgeClass edge_class : {EdgeClass::regular, EdgeClass::inconsistent,
                                           EdgeClass::nonmanifold, EdgeClass::border})
            CHECK(model.mesh.edges_of_class(edge_class).size() > 0);
        check_paths(*gpu, "soup " + std::to_string(seed), model);
    }
}

TEST_CASE("line paths without slots keep no tracker and stream nothing for the camera") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("knot", 2000));
    const Scene scene = line_scene(model, false);
    for (const LinePath path : {LinePath::geometry, LinePath::pulling, LinePath::all_edges,
                                LinePath::quads, LinePath::adjacency}) {
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1, .line_path = path});
        renderer.render(scene, 32, 32);
        CHECK((renderer.report().bytes_streamed > 0) == draws_slots(path));
        CHECK(renderer.silhouette(0, std::nullopt).has_value() == draws_slots(path));
    }
}

// A device on which geometry shaders were not enabled.
class PlainDevice {
public:
    explicit PlainDevice(const tests::Gpu& gpu) {
        const DeviceContext& full = gpu.context();
        VkPhysicalDeviceVulkan13Features v13{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
            .synchronization2 = VK_TRUE,
            .dynamicRendering = VK_TRUE,
            .maintenance4 = VK_TRUE};
        VkPhysicalDeviceVulkan12Features v12{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
            .pNext = &v13,
            .scalarBlockLayout = VK_TRUE,
            .timelineSemaphore = VK_TRUE,
            .bufferDeviceAddress = VK_TRUE};
        const VkPhysicalDeviceFeatures v10{.depthClamp = VK_TRUE};
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queue_info{
            .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
            .queueFamilyIndex = full.queue_family,
            .queueCount = 1,
            .pQueuePriorities = &priority};
        const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                      .pNext = &v12,
                                      .queueCreateInfoCount = 1,
                                      .pQueueCreateInfos = &queue_info,
                                      .pEnabledFeatures = &v10};
        REQUIRE(full.vk->CreateDevice(full.physical_device, &info, nullptr, &device_) ==
                VK_SUCCESS);
        VkQueue queue = VK_NULL_HANDLE;
        full.vk->GetDeviceQueue(device_, full.queue_family, 0, &queue);
        context_ = make_device_context({.instance = gpu.instance().handle(),
                                        .physical_device = full.physical_device,
                                        .device = device_,
                                        .queue = queue,
                                        .queue_family = full.queue_family});
    }
    ~PlainDevice() {
        context_.allocator.reset();
        context_.vk->DestroyDevice(device_, nullptr);
    }
    PlainDevice(const PlainDevice&) = delete;
    PlainDevice& operator=(const PlainDevice&) = delete;

    const DeviceContext& context() const noexcept { return context_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    DeviceContext context_;
};

TEST_CASE("a device without geometry shaders draws the same picture, lines and shadows") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("scene", 2000));
    Scene scene = line_scene(model, false);
    scene.palette.shade = glm::vec3(0.5f);
    scene.shadows = true;
    scene.lights = {default_sun(scene.camera)};
    const PictureLines lines{{{-0.1, -0.2}, {0.1, 0.2}}, {{0, 2}}};
    scene.instances.push_back({.octree = &model.octree, .picture_lines = &lines});
    const Picture expected = draw(*gpu, scene, LinePath::geometry);
    const PlainDevice plain(*gpu);
    Renderer renderer(plain.context(), {.samples = 1, .scale = 1});
    CHECK(differ_within(expected, renderer.render(scene, k_line_path_size, k_line_path_size),
                        line_path_bound(gpu->context().driver)));
}

TEST_CASE("without geometry shaders lines are pulled, and paths that need them are refused") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext lacking = gpu->context();
    lacking.features.geometry_shader = false;
    const DrawData data(lacking, 1);
    CHECK(LinePass(lacking, data.layout(), k_surface_format).path() == LinePath::pulling);
    CHECK(LinePass(lacking, data.layout(), k_surface_format, LinePath::quads).path() ==
          LinePath::quads);
    for (const LinePath path : {LinePath::all_edges, LinePath::adjacency}) try {
            LinePass(lacking, data.layout(), k_surface_format, path);
            FAIL("a path was accepted that the device cannot draw");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::no_device);
            CHECK(std::string(error.what()).find("geometry shaders") != std::string::npos);
        }
}

}  // namespace
}  // namespace rimline
