#include "engine/vulkan/uploads.h"
#include "engine/vulkan/commands.h"

#include <cstring>
#include <numeric>
#include <random>

#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

using namespace rimline::tests;

std::vector<std::uint32_t> random_words(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> words(count);
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
    return words;
}

std::vector<std::uint32_t> read(const Gpu& gpu, const Buffer& buffer, std::size_t count) {
    std::vector<std::uint32_t> words(count);
    read_buffer(gpu.context(), buffer, std::as_writable_bytes(std::span(words)));
    return words;
}

TEST_CASE(
    "what was sent is there when the timeline says so, on a queue that waits for it or here") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext& context = gpu->context();
    Uploads uploads(context);
    CHECK(uploads.is_done());
    std::vector<Buffer> buffers;
    std::vector<std::vector<std::uint32_t>> sent;
    constexpr std::uint32_t k_batches = 20;
    for (std::uint32_t number = 0; number < k_batches; ++number) {
        UploadBatch batch(context, uploads);
        for (std::uint32_t i = 0; i < 4; ++i) {
            sent.push_back(random_words(std::size_t{i} * 5000 + 1, 4 * number + i));
            buffers.push_back(batch.add(std::span<const std::uint32_t>(sent.back()), "a test"));
        }
        const std::uint64_t before = uploads.sent().value;
        batch.send();
        CHECK(uploads.sent().value == before + 1);
    }
    // One that reads on the queue that draws waits there, not here.
    const std::size_t last = buffers.size() - 1;
    const Buffer result(context, buffers[last].size(), BufferPlace::readback, "a test");
    const OwnedCommandPool pool = make_command_pool(context, "test", context.queue_family);
    const Commands commands = begin_commands(context, make_commands(context, pool));
    const VkBufferCopy region{.size = buffers[last].size()};
    commands->CmdCopyBuffer(commands, buffers[last].handle(), result.handle(), 1, &region);
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    const OwnedSemaphore drawn = make_timeline(context, "test");
    submit_commands(context, {.queue = context.queue,
                              .commands = commands,
                              .waits = {uploads.sent()},
                              .signal = SemaphorePoint{drawn, 1}});
    wait_for_timeline(context, drawn, 1);
    CHECK(std::memcmp(result.mapped(), sent[last].data(), 4 * sent[last].size()) == 0);

    uploads.wait();
    CHECK(uploads.is_done());
    for (std::size_t i = 0; i < buffers.size(); ++i)
        CHECK(read(*gpu, buffers[i], sent[i].size()) == sent[i]);
}

TEST_CASE("a batch that is not sent, and one without data, leave nothing behind") {
    RIMLINE_OPEN_GPU(gpu);
    Uploads uploads(gpu->context());
    {
        UploadBatch batch(gpu->context(), uploads);
        const std::vector<std::uint32_t> words(100, 7);
        const Buffer gone = batch.add(std::span<const std::uint32_t>(words), "a test");
    }
    UploadBatch empty(gpu->context(), uploads);
    CHECK(empty.add(std::span<const std::uint32_t>(), "a test").size() == 4);
    empty.send();
    CHECK(uploads.sent().value == 0);
    CHECK(uploads.is_done());
}

TEST_CASE("a batch larger than what may be staged at once is sent in parts") {
    RIMLINE_OPEN_GPU(gpu);
    Uploads uploads(gpu->context());
    UploadBatch batch(gpu->context(), uploads);
    constexpr std::size_t k_count = (UploadBatch::k_max_staged_bytes / 4) * 2 / 3;
    std::vector<Buffer> buffers;
    for (std::uint32_t i = 0; i < 3; ++i)
        buffers.push_back(
            batch.add(std::span<const std::uint32_t>(random_words(k_count, i)), "a test"));
    CHECK(uploads.sent().value == 2);
    batch.send();
    CHECK(uploads.sent().value == 3);
    uploads.wait();
    for (std::uint32_t i = 0; i < 3; ++i)
        CHECK(read(*gpu, buffers[i], k_count) == random_words(k_count, i));
}

TEST_CASE("data larger than what may be staged at once is sent in parts") {
    RIMLINE_OPEN_GPU(gpu);
    Uploads uploads(gpu->context());
    UploadBatch batch(gpu->context(), uploads);
    constexpr std::size_t k_count = (UploadBatch::k_max_staged_bytes / 4) * 5 / 2 + 3;
    const std::vector<std::uint32_t> words = random_words(k_count, 5);
    const Buffer buffer = batch.add(std::span<const std::uint32_t>(words), "a test");
    CHECK(uploads.sent().value == 2);
    batch.send();
    CHECK(uploads.sent().value == 3);
    uploads.wait();
    CHECK(read(*gpu, buffer, k_count) == words);
}

TEST_CASE("a device of a caller's with one queue uploads over that") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext& own = gpu->context();
    const DeviceContext context = make_device_context({.instance = gpu->instance().handle(),
                                                       .physical_device = own.physical_device,
                                                       .device = own.device,
                                                       .queue = own.queue,
                                                       .queue_family = own.queue_family,
                                                       .features = own.features});
    CHECK(context.transfer_queue == own.queue);
    CHECK(context.transfer_family == own.queue_family);
}

}  // namespace
}  // namespace rimline
