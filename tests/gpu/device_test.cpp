#include "engine/device.h"

#include <cstring>

#include "engine/memory.h"
#include "tests/gpu/gpu_fixture.h"

namespace rimline {
namespace {

TEST_CASE("an opened device says who it is and decides face bits as the CPU does") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_FALSE(gpu->device().facts().name.empty());
    CHECK_FALSE(gpu->device().facts().driver.empty());
    CHECK(gpu->device().face_bits_agree());
    CHECK(gpu->context().samples >= 1);
}

TEST_CASE("asking for a device that is not there is an error that names it") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_THROWS_WITH_AS(Device(gpu->instance(), "no such device"),
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

TEST_CASE("a deliberate misuse is counted where the validation layer is installed") {
    std::optional<VulkanInstance> instance;
    try {
        instance.emplace(InstanceOptions{.validate = true});
    } catch (const Error& error) {
        RIMLINE_SKIP(error.what());
    }
    std::optional<Device> device;
    try {
        device.emplace(*instance);
    } catch (const Error& error) {
        RIMLINE_SKIP(error.what());
    }
    REQUIRE(instance->validation_message_count() == 0u);
    // A range past the end of the buffer it fills.
    const Buffer buffer(device->context(), 64, BufferPlace::device, "test");
    run_commands(device->context(), [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer.handle(), 2, 4, 0);
    });
    CHECK(instance->validation_message_count().value() > 0);
    CHECK_FALSE(instance->first_validation_message().empty());
}

}  // namespace
}  // namespace rimline
