#include "engine/frame/clear_area.h"

#include <doctest/doctest.h>

#include <vector>

#include "engine/picture_readback.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/commands.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

constexpr VkExtent2D k_clear_area_size{160, 96};

TEST_CASE("the CPU and GPUs that draw tiles clear what they draw, and other GPUs the whole image") {
    for (const VkDriverId driver : {VK_DRIVER_ID_MESA_LLVMPIPE, VK_DRIVER_ID_GOOGLE_SWIFTSHADER,
                                    VK_DRIVER_ID_MESA_RADV, VkDriverId{}})
        CHECK(choose_clear_area(VK_PHYSICAL_DEVICE_TYPE_CPU, driver) == ClearArea::drawn);
    for (const VkPhysicalDeviceType type :
         {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
          VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER}) {
        for (const VkDriverId driver :
             {VK_DRIVER_ID_MESA_RADV, VK_DRIVER_ID_AMD_OPEN_SOURCE, VK_DRIVER_ID_AMD_PROPRIETARY,
              VK_DRIVER_ID_NVIDIA_PROPRIETARY, VK_DRIVER_ID_INTEL_OPEN_SOURCE_MESA,
              VK_DRIVER_ID_INTEL_PROPRIETARY_WINDOWS, VkDriverId{}})
            CHECK(choose_clear_area(type, driver) == ClearArea::whole);
        for (const VkDriverId driver :
             {VK_DRIVER_ID_MOLTENVK, VK_DRIVER_ID_ARM_PROPRIETARY, VK_DRIVER_ID_MESA_TURNIP,
              VK_DRIVER_ID_QUALCOMM_PROPRIETARY, VK_DRIVER_ID_IMAGINATION_PROPRIETARY})
            CHECK(choose_clear_area(type, driver) == ClearArea::drawn);
    }
}

PFN_vkCmdBeginRendering begin_rendering = nullptr;
std::vector<VkRect2D> cleared;  // The render areas of scopes that clear.

VKAPI_ATTR void VKAPI_CALL note_area(VkCommandBuffer commands, const VkRenderingInfo* info) {
    if (info->pColorAttachments[0].loadOp == VK_ATTACHMENT_LOAD_OP_CLEAR)
        cleared.push_back(info->renderArea);
    begin_rendering(commands, info);
}

// The machine's device, taken for one of this type.
DeviceContext taken_for(const DeviceContext& own, VkPhysicalDeviceType type, VkDriverId driver) {
    DeviceContext context = tests::with_functions(own, [](DeviceFunctions& vk) {
        begin_rendering = vk.CmdBeginRendering;
        vk.CmdBeginRendering = &note_area;
    });
    context.type = type;
    context.driver = driver;
    return context;
}

// The picture of a target that is used so, after the frame of another scene.
Picture draw(const DeviceContext& context, const RendererOptions& options, const Scene& before,
             const Scene& scene, PictureUse use) {
    Renderer renderer(context, options);
    const Image image = make_picture_image(context, k_clear_area_size);
    const Buffer pixels = make_picture_buffer(context, k_clear_area_size);
    PictureTarget target = picture_target(image);
    target.use = use;
    for (const Scene* drawn : {&before, &scene}) {
        const UploadPoint uploaded = renderer.prepare(*drawn, target);
        cleared.clear();
        run_commands(
            context,
            [&](Commands commands) {
                renderer.record(commands, *drawn, target);
                record_read_back(commands, image.handle(), k_clear_area_size, pixels);
            },
            uploaded);
    }
    return read_picture(pixels, k_clear_area_size);
}

TEST_CASE("a picture is the same whatever is cleared and a GPU clears whole images" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext cpu =
        taken_for(gpu->context(), VK_PHYSICAL_DEVICE_TYPE_CPU, VK_DRIVER_ID_MESA_LLVMPIPE);
    const DeviceContext radv =
        taken_for(gpu->context(), VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_DRIVER_ID_MESA_RADV);
    const tests::Model model(make_built_in_shape("knot", 2000));
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}),
                                     double(k_clear_area_size.width) / k_clear_area_size.height)};
    scene.instances.push_back({.octree = &model.octree});
    scene.lights = {default_sun(scene.camera), {.vector = {0.4, 3.0, 1.0}, .directional = false}};
    Scene before = scene;  // Leaves something beside what is drawn next.
    before.instances[0].translation = {1.5, 0.5, 0.0};
    for (const PictureUse use : {PictureUse::whole, PictureUse::layer})
        for (std::uint32_t samples : {1u, 4u}) {
            if ((gpu->context().sample_counts & samples) == 0) continue;
            CAPTURE(static_cast<int>(use));
            CAPTURE(samples);
            const RendererOptions options{
                .samples = samples, .scale = 2, .line_path = LinePath::pulling};
            const Picture expected = draw(cpu, options, before, scene, use);
            const std::vector<VkRect2D> parts = cleared;
            CHECK(draw(radv, options, before, scene, use).rgba == expected.rgba);
            const std::vector<VkRect2D> wholes = cleared;
            REQUIRE(parts.size() == wholes.size());
            // The last scope clears a caller's image, and is the same on both.
            REQUIRE(parts.size() == (use == PictureUse::layer ? 3 : 2));
            for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
                CHECK(parts[i].extent.width < 2 * k_clear_area_size.width);
                CHECK(wholes[i].offset.x == 0);
                CHECK(wholes[i].extent.width == 2 * k_clear_area_size.width);
                CHECK(wholes[i].extent.height == 2 * k_clear_area_size.height);
            }
        }
}

}  // namespace
}  // namespace rimline
