#include "engine/vulkan/commands.h"
#include "engine/vulkan/device_context.h"

#include <cstring>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/barrier.h"
#include "engine/vulkan/memory.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/masking_loader.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

TEST_CASE("an opened device says who it is and decides face bits as the CPU does") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_FALSE(gpu->device().facts().name.empty());
    CHECK_FALSE(gpu->device().facts().driver.empty());
    CHECK(gpu->device().face_bits_agree());
    CHECK((gpu->context().sample_counts & VK_SAMPLE_COUNT_1_BIT) != 0);
}

TEST_CASE("a device of a caller's instance is judged as one of Rimline's own") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceFacts facts = describe_device(
        gpu->instance().handle(), gpu->context().physical_device, gpu->instance().loader());
    CHECK(facts.name == gpu->device().facts().name);
    CHECK_FALSE(facts.shows_window);
    CHECK(judge_device(facts).usable());
    CHECK(describe_device(gpu->instance().handle(), gpu->context().physical_device).driver ==
          facts.driver);
}

TEST_CASE(
    "tests on a device that RIMLINE_DEVICE names and that is not there fail and do not skip") {
    RIMLINE_OPEN_GPU(gpu);
    const std::string before = tests::requested_device();
    REQUIRE(setenv("RIMLINE_DEVICE", "no such device", 1) == 0);
    std::string reason;
    CHECK_THROWS_WITH_AS(tests::Gpu::open(reason), doctest::Contains("'no such device'"), Error);
    REQUIRE(setenv("RIMLINE_DEVICE", gpu->device().facts().name.c_str(), 1) == 0);
    const std::unique_ptr<tests::Gpu> same = tests::Gpu::open(reason);
    REQUIRE(same != nullptr);
    CHECK(same->device().facts().name == gpu->device().facts().name);
    REQUIRE(setenv("RIMLINE_DEVICE", before.c_str(), 1) == 0);
}

TEST_CASE("asking for a device that is not there is an error that names it") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_THROWS_WITH_AS(TestedDevice(gpu->instance(), "no such device"),
                         doctest::Contains("'no such device'"), Error);
}

TEST_CASE("what is uploaded can be read back") {
    RIMLINE_OPEN_GPU(gpu);
    std::vector<std::uint32_t> sent(100'001);
    for (std::uint32_t i = 0; i < sent.size(); ++i) sent[i] = i * 2654435761u;
    const Buffer buffer =
        upload_buffer(gpu->context(), std::span<const std::uint32_t>(sent), "test");
    std::vector<std::uint32_t> received(sent.size());
    read_buffer(gpu->context(), buffer, std::as_writable_bytes(std::span(received)));
    CHECK(received == sent);
}

TEST_CASE(
    "a buffer beyond the device's memory and an image beyond its limit are errors that say so") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_THROWS_WITH_AS(
        Buffer(gpu->context(), VkDeviceSize{1} << 46, BufferPlace::device, "a model"),
        doctest::Contains("a model"), Error);
    const std::uint32_t side = gpu->context().limits.maxImageDimension2D + 1;
    CHECK_THROWS_WITH_AS(Image(gpu->context(),
                               {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                .extent = {side, 1},
                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
                               "the picture"),
                         doctest::Contains("maxImageDimension2D"), Error);
}

TEST_CASE("a device without rounding to even draws everything but meshes that deform") {
    RIMLINE_OPEN_GPU(unmasked);
    const tests::Masked mask({.round_to_nearest = false});
    std::string reason;
    const std::unique_ptr<tests::Gpu> gpu = tests::Gpu::open(reason, &tests::masking_loader);
    REQUIRE_MESSAGE(gpu != nullptr, reason);
    CHECK_FALSE(gpu->device().facts().round_to_nearest_float32);
    CHECK_FALSE(gpu->context().round_to_nearest_float32);
    CHECK_FALSE(gpu->device().face_bits_agree());
    const tests::Model model(make_built_in_shape("knot", 1000));
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}), 1.0)};
    scene.instances.push_back({.octree = &model.octree});
    scene.lights.push_back(default_sun(scene.camera));
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Picture expected = renderer.render(scene, 64, 64);
    Scene deforming = scene;
    deforming.instances[0].octree = nullptr;
    deforming.instances[0].deforming = &model.mesh;
    deforming.instances[0].deformation = default_wave(model.mesh, {0, 1, 0}, 0.2);
    try {
        renderer.render(deforming, 64, 64);
        FAIL("a mesh deformed without rounding to even");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::no_device);
        CHECK(std::string(error.what()).find("a mesh that deforms needs RoundingModeRTE") !=
              std::string::npos);
    }
    CHECK(renderer.render(scene, 64, 64).rgba == expected.rgba);
}

TEST_CASE("for a window only a device is opened whose queue presents to the window's surface") {
    // Never looked at but by the loader below.
    const auto surface = reinterpret_cast<VkSurfaceKHR>(std::uintptr_t{16});
    RIMLINE_OPEN_GPU(gpu);
    const DeviceRequest name = gpu->device().facts().name;
    if (!gpu->device().facts().swapchain) RIMLINE_SKIP("the device has no swapchains");
    for (const bool presents : {true, false}) {
        CAPTURE(presents);
        const tests::Masked mask({.presents = presents});
        const VulkanInstance instance({.loader = &tests::masking_loader});
        for (const DeviceFacts& facts : describe_devices(instance, surface))
            CHECK(facts.shows_window == (facts.swapchain && presents));
        for (const DeviceFacts& facts : describe_devices(instance))
            CHECK_FALSE(facts.shows_window.has_value());
        if (presents)
            CHECK(Device(instance, name, {}, surface).facts().name == name);
        else
            CHECK_THROWS_WITH_AS(Device(instance, name, {}, surface),
                                 doctest::Contains("can show pictures in this window"), Error);
    }
}

// What the validation layer says to `record`, which may use a buffer of 64 bytes; nothing where there is
// no layer or no device.
std::optional<std::string> first_message(const std::function<void(Commands, const Buffer&)>& record,
                                         std::string& reason) {
    try {
        const VulkanInstance instance({.validate = true});
        const TestedDevice device(instance, tests::requested_device());
        REQUIRE(instance.validation_message_count() == 0u);
        const Buffer buffer(device.context(), 64, BufferPlace::device, "test");
        run_commands(device.context(), [&](Commands commands) { record(commands, buffer); });
        CHECK((instance.validation_message_count().value() > 0) ==
              !instance.first_validation_message().empty());
        return instance.first_validation_message();
    } catch (const Error& error) {
        reason = error.what();
        return std::nullopt;
    }
}

TEST_CASE("a deliberate misuse is counted where the validation layer is installed") {
    std::string reason;
    const auto message = first_message(
        [](Commands commands, const Buffer& buffer) {
            commands->CmdFillBuffer(commands, buffer.handle(), 2, 4,
                                    0);  // Offsets are multiples of 4.
        },
        reason);
    if (!message) RIMLINE_SKIP(reason);
    CHECK(message->find("VUID-vkCmdFillBuffer-dstOffset-00025") != std::string::npos);
}

TEST_CASE("a missing barrier is counted where the validation layer is installed") {
    std::string reason;
    const auto fill = [](Commands commands, const Buffer& buffer, std::uint32_t value) {
        commands->CmdFillBuffer(commands, buffer.handle(), 0, VK_WHOLE_SIZE, value);
    };
    const auto message = first_message(
        [&](Commands commands, const Buffer& buffer) {
            fill(commands, buffer, 1);
            fill(commands, buffer, 2);  // Which of the two comes last is open.
        },
        reason);
    if (!message) RIMLINE_SKIP(reason);
    CAPTURE(*message);
    CHECK(message->find("WRITE_AFTER_WRITE") != std::string::npos);
    const auto silence = first_message(
        [&](Commands commands, const Buffer& buffer) {
            constexpr StageAccess k_filling{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                            VK_ACCESS_2_TRANSFER_WRITE_BIT};
            fill(commands, buffer, 1);
            record_barrier(commands, k_filling, k_filling);
            fill(commands, buffer, 2);
        },
        reason);
    CHECK(silence.value_or("no device") == std::string());
}

}  // namespace
}  // namespace rimline
