#include "engine/vulkan/uploads.h"

#include <algorithm>
#include <cstring>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"

namespace rimline {

Uploads::Uploads(const DeviceContext& context)
    : context_(context), timeline_(make_timeline(context, "uploads")) {}

Uploads::~Uploads() {
    if (sent_ == 0) return;
    // By the specification, frames that waited for the timeline no longer use it when they have ended. But the
    // queues of Mesa's lavapipe (22.3) access it once more afterwards, until the next submission begins.
    if (context_.driver == VK_DRIVER_ID_MESA_LLVMPIPE) {
        drain(context_, context_.transfer_queue);
        if (context_.queue != context_.transfer_queue) drain(context_, context_.queue);
        return;
    }
    try {
        wait();
    } catch (const Error&) {
        // A lost device copies nothing any more.
    }
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
        const VkBufferCopy region{.dstOffset = copy.target_offset, .size = copy.size};
        if (copy.image != VK_NULL_HANDLE)
            record_image(commands, copy);
        else if (region.size == 0)
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

void Uploads::record_image(Commands commands, const StagedCopy& copy) const {
    const auto move = [&](VkImageLayout from, VkImageLayout to, VkAccessFlags2 before,
                          VkAccessFlags2 after) {
        // Readers wait for the timeline, which waits for this stage.
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, before},
                       {VK_PIPELINE_STAGE_2_COPY_BIT, after},
                       {{copy.image, static_cast<std::uint32_t>(copy.levels.size()), from, to}});
    };
    move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_2_NONE,
         VK_ACCESS_2_TRANSFER_WRITE_BIT);
    commands->CmdCopyBufferToImage(
        commands, copy.staging.handle(), copy.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        static_cast<std::uint32_t>(copy.levels.size()), copy.levels.data());
    move(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
         VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_NONE);
}

Buffer UploadBatch::stage(std::uint64_t size_bytes, const std::string& what) {
    if (staged_bytes_ + size_bytes > k_max_staged_bytes && !staged_.empty()) {
        send();
        uploads_.wait();
    }
    Buffer staging(context_, size_bytes, BufferPlace::upload, what);
    staged_bytes_ += size_bytes;
    return staging;
}

Image UploadBatch::add_image(VkFormat format, std::span<const Picture> levels,
                             const std::string& what) {
    Image image(context_,
                {.format = format,
                 .extent = {levels[0].width, levels[0].height},
                 .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                 .mip_levels = static_cast<std::uint32_t>(levels.size()),
                 .is_shared = true},
                what);
    std::uint64_t size_bytes = 0;
    for (const Picture& level : levels) size_bytes += level.rgba.size();
    Uploads::StagedCopy copy{
        .staging = stage(size_bytes, what), .target = VK_NULL_HANDLE, .image = image.handle()};
    std::uint64_t offset_bytes = 0;
    for (const Picture& level : levels) {
        copy.levels.push_back(
            {.bufferOffset = offset_bytes,
             .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT,
                                  static_cast<std::uint32_t>(copy.levels.size()), 0, 1},
             .imageExtent = {level.width, level.height, 1}});
        std::memcpy(copy.staging.mapped() + offset_bytes, level.rgba.data(), level.rgba.size());
        offset_bytes += level.rgba.size();
    }
    staged_.push_back(std::move(copy));
    return image;
}

Buffer UploadBatch::add(std::span<const std::byte> data, const std::string& what) {
    Buffer buffer(context_, data.size(), BufferPlace::device, what);
    for (std::size_t first = 0; first < data.size(); first += k_max_staged_bytes) {
        const std::span<const std::byte> part =
            data.subspan(first, std::min<std::size_t>(k_max_staged_bytes, data.size() - first));
        Buffer staging = stage(part.size(), what);
        std::memcpy(staging.mapped(), part.data(), part.size());
        staged_.push_back({std::move(staging), buffer.handle(), first, part.size()});
    }
    return buffer;
}

Buffer UploadBatch::add_zeros(VkDeviceSize size_bytes, const std::string& what) {
    Buffer buffer(context_, size_bytes, BufferPlace::device, what);
    staged_.push_back({.staging = {}, .target = buffer.handle()});
    return buffer;
}

void UploadBatch::send() {
    if (!staged_.empty()) uploads_.send(staged_);
    staged_.clear();
    staged_bytes_ = 0;
}

}  // namespace rimline
