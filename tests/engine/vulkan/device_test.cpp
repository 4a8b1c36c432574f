#include "engine/vulkan/commands.h"
#include "engine/vulkan/device_context.h"

#include <cstring>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/memory.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

TEST_CASE("an opened device says who it is and decides face bits as the CPU does") {
    RIMLINE_OPEN_GPU(gpu);
    CHECK_FALSE(gpu->device().facts().name.empty());
    CHECK_FALSE(gpu->device().facts().driver.empty());
    CHECK(gpu->device().face_bits_agree());
    CHECK((gpu->context().sample_counts & VK_SAMPLE_COUNT_1_BIT) != 0);
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
    CHECK(message->find("SYNC-HAZARD-WRITE-AFTER-WRITE") != std::string::npos);
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
