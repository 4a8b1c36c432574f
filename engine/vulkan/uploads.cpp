#include "engine/vulkan/uploads.h"
#include "engine/vulkan/commands.h"

#include <cstring>

namespace rimline {

Uploads::Uploads(const DeviceContext& context)
    : context_(context), timeline_(make_timeline(context, "uploads")) {}

Uploads::~Uploads() {
    // By the specification, frames that waited for the timeline no longer use it when they have ended. But
    // Mesa's queues (22.3) access it once more afterwards, until the next submission begins.
    drain(context_, context_.transfer_queue);
    if (context_.queue != context_.transfer_queue) drain(context_, context_.queue);
}

void Uploads::wait() {
    if (in_flight_.empty()) return;
    wait_for_timeline(context_, timeline_, sent_);
    in_flight_.clear();
}

bool Uploads::is_done() noexcept {
    std::uint64_t reached = 0;
    if (!in_flight_.empty() &&
        context_.vk->GetSemaphoreCounterValue(context_.device, timeline_, &reached) == VK_SUCCESS)
        while (!in_flight_.empty() && in_flight_.front().value <= reached) in_flight_.pop_front();
    return in_flight_.empty();
}

void Uploads::send(std::vector<StagedCopy>& copies) {
    is_done();  // Frees finished copies.
    OwnedCommandPool pool = make_command_pool(context_, "uploads", context_.transfer_family);
    const Commands commands = begin_commands(context_, make_commands(context_, pool));
    for (const StagedCopy& copy : copies) {
        const VkBufferCopy region{.size = copy.staging.size()};
        if (region.size == 0)
            commands->CmdFillBuffer(commands, copy.target, 0, VK_WHOLE_SIZE, 0);
        else
            commands->CmdCopyBuffer(commands, copy.staging.handle(), copy.target, 1, &region);
    }
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    // May throw, so before the submission, which cannot be undone.
    Sent& sent = in_flight_.emplace_back(Sent{sent_ + 1, std::move(pool), {}});
    try {
        submit_commands(context_, {.queue = context_.transfer_queue,
                                   .commands = commands,
                                   .signal = SemaphorePoint{timeline_, sent_ + 1}});
    } catch (...) {
        in_flight_.pop_back();
        throw;
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

Buffer UploadBatch::add_zeros(VkDeviceSize size_bytes, const std::string& what) {
    Buffer buffer(context_, size_bytes, BufferPlace::device, what);
    staged_.push_back({{}, buffer.handle()});
    return buffer;
}

void UploadBatch::send() {
    if (!staged_.empty()) uploads_.send(staged_);
    staged_.clear();
    staged_bytes_ = 0;
}

}  // namespace rimline
