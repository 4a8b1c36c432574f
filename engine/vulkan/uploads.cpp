#include "engine/vulkan/uploads.h"
#include "engine/vulkan/commands.h"

#include <cstring>

namespace rimline {

Uploads::Uploads(const DeviceContext& context)
    : context_(context), timeline_(make_timeline(context)) {}

Uploads::~Uploads() {
    // A lost device runs nothing any more. By the specification, frames that waited for the timeline no
    // longer use it when they have ended. But Mesa's queues (22.3) access it once more afterwards, unless
    // they are idle.
    for (const VkQueue queue : {context_.transfer_queue, context_.queue})
        (void)repeat_wait([&] { return vkQueueWaitIdle(queue); });
}

void Uploads::wait() {
    if (in_flight_.empty()) return;
    wait_for_timeline(context_, timeline_, sent_);
    in_flight_.clear();
}

bool Uploads::is_done() noexcept {
    std::uint64_t reached = 0;
    if (!in_flight_.empty() &&
        vkGetSemaphoreCounterValue(context_.device, timeline_, &reached) == VK_SUCCESS)
        while (!in_flight_.empty() && in_flight_.front().value <= reached) in_flight_.pop_front();
    return in_flight_.empty();
}

void Uploads::send(std::vector<StagedCopy>& copies) {
    is_done();  // Frees finished copies.
    OwnedCommandPool pool = make_command_pool(context_, context_.transfer_family);
    const VkCommandBuffer commands = begin_commands(context_, pool);
    for (const StagedCopy& copy : copies) {
        const VkBufferCopy region{.size = copy.staging.size()};
        vkCmdCopyBuffer(commands, copy.staging.handle(), copy.target, 1, &region);
    }
    vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkCommandBufferSubmitInfo submitted{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = timeline_,
                                       .value = sent_ + 1,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &submitted,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &signal};
    // May throw, so before the submission, which cannot be undone.
    Sent& sent = in_flight_.emplace_back(Sent{sent_ + 1, std::move(pool), {}});
    const VkResult result = vkQueueSubmit2(context_.transfer_queue, 1, &submit, VK_NULL_HANDLE);
    if (result != VK_SUCCESS) {
        in_flight_.pop_back();
        vk_check(result, "vkQueueSubmit2");
    }
    sent.copies.swap(copies);
    ++sent_;
}

Buffer UploadBatch::add(std::span<const std::byte> data, const std::string& what) {
    Buffer buffer(context_, data.size(), BufferPlace::device, what);
    if (data.empty()) return buffer;
    if (staged_bytes_ + data.size() > k_max_staged_bytes && !staged_.empty()) {
        send();
        uploads_.wait();
    }
    Buffer staging(context_, data.size(), BufferPlace::upload, what);
    std::memcpy(staging.mapped(), data.data(), data.size());
    staged_.push_back({std::move(staging), buffer.handle()});
    staged_bytes_ += data.size();
    return buffer;
}

void UploadBatch::send() {
    if (!staged_.empty()) uploads_.send(staged_);
    staged_.clear();
    staged_bytes_ = 0;
}

}  // namespace rimline
