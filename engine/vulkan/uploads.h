#pragma once

// Copies of data into device buffers and images, on the queue for copies (queue_choice.h).
//
//     UploadBatch::add():  data --memcpy--> staging                      any time
//     UploadBatch::send(): staging --copied--> buffers, timeline = n     the queue for copies
//     a frame:             waits for timeline >= n, reads them           the queue that draws
//
// Only the readers wait: copies run in parallel with frames in flight. If there is one queue for both, the
// same commands and the same semaphore are used there. Device buffers are shared by both families (memory.h),
// so ownership is never transferred, and cannot be lost when a frame is dropped.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/upload_point.h"
#include "silhouette/picture.h"

namespace rimline {

/// The copies that were sent and may still be in progress. Each user of a device has its own.
class Uploads {
public:
    /// The context's device must outlive it.
    explicit Uploads(const DeviceContext& context);
    /// Waits until all copies are done. Frames that wait for them must have ended. On Mesa's CPU device, if anything
    /// was sent, it submits to the context's queues and waits for all that they have to do.
    ~Uploads();
    Uploads(const Uploads&) = delete;
    Uploads& operator=(const Uploads&) = delete;

    /// Reached when all copies are done. Commands that read the buffers must wait for it.
    UploadPoint sent() const noexcept { return {timeline_, sent_}; }

    /// Waits on the host until all copies are done. Throws what vk_check() does.
    void wait();
    /// Whether all copies are done, so that what they used is free. Also false if the device cannot tell.
    /// Commands that read the buffers must wait for the timeline nevertheless: only that makes the copies
    /// visible to them.
    bool is_done() noexcept;

private:
    friend class UploadBatch;

    struct StagedCopy {
        Buffer staging;  // Empty: the target is filled with zeros.
        VkBuffer target;
        // Where `size` bytes go.
        VkDeviceSize target_offset = 0;
        VkDeviceSize size = 0;
        // If set, the target is this image, of these levels.
        VkImage image = VK_NULL_HANDLE;
        std::vector<VkBufferImageCopy> levels = {};
    };
    struct Sent {
        std::uint64_t value;
        OwnedCommandPool pool;
        std::vector<StagedCopy> copies;
    };

    void send(std::vector<StagedCopy>& copies);
    void record_image(Commands commands, const StagedCopy& copy) const;

    DeviceContext context_;
    OwnedSemaphore timeline_;
    std::uint64_t sent_ = 0;
    std::deque<Sent> in_flight_;
};

/// Buffers that are filled together. A batch that is not sent has no effect.
class UploadBatch {
public:
    explicit UploadBatch(const DeviceContext& context, Uploads& uploads)
        : context_(context), uploads_(uploads) {}

    const DeviceContext& context() const noexcept { return context_; }

    /// A device buffer that holds `data` after the batch is sent and the copies are done. The buffer must exist until
    /// then; `data` is not needed after the call. If more than k_max_staged_bytes would be staged, what is staged is
    /// sent and waited for; so are the parts of data that is larger. Throws as Buffer, and what vk_check() does.
    Buffer add(std::span<const std::byte> data, const std::string& what);
    template <typename T>
    Buffer add(std::span<const T> data, const std::string& what) {
        return add(std::as_bytes(data), what);
    }

    /// A color image of four bytes a pixel with these mip levels, the largest first, likewise. It is to be sampled, in
    /// SHADER_READ_ONLY_OPTIMAL. It is staged as a whole. Throws as Image.
    Image add_image(VkFormat format, std::span<const Picture> levels, const std::string& what);

    /// A device buffer of zeros, likewise.
    Buffer add_zeros(VkDeviceSize size_bytes, const std::string& what);

    /// Begins the copies. Does not wait. Throws what vk_check() does; then nothing is copied.
    void send();

    /// Limit of host memory for staging, but for an image that is larger: 64 MiB.
    static constexpr std::uint64_t k_max_staged_bytes = std::uint64_t{64} << 20;

private:
    // Sends first if there would be too much.
    Buffer stage(std::uint64_t size_bytes, const std::string& what);

    const DeviceContext& context_;
    Uploads& uploads_;
    std::vector<Uploads::StagedCopy> staged_;
    std::uint64_t staged_bytes_ = 0;
};

/// What `make` returns, called with a batch, when its copies are done and visible to the queue that draws.
/// Throws what `make` and vk_check() do.
template <typename Make>
auto upload_at_once(const DeviceContext& context, Make&& make) {
    // First: where something throws, `uploads` waits before the buffers end.
    std::optional<std::invoke_result_t<Make&, UploadBatch&>> made;
    Uploads uploads(context);
    UploadBatch batch(context, uploads);
    made.emplace(make(batch));
    batch.send();
    run_commands(
        context, [](Commands) {}, uploads.sent());
    return *std::move(made);
}

}  // namespace rimline
