#pragma once

// Data on its way into device buffers, over the queue for copies (queue_choice.h).
//
//     UploadBatch::add():  data --memcpy--> staging                      any time
//     UploadBatch::send(): staging --copied--> buffers, timeline = n     the queue for copies
//     a frame:             waits for timeline >= n, reads them           the queue that draws
//
// Nobody waits but who reads: copies run beside frames that are in flight. Where one queue does both, the
// same commands and the same semaphore go there. Buffers for the GPU alone are shared by both families
// (memory.h), so there is no ownership to hand over, and none to lose when a frame is dropped.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/memory.h"

namespace rimline {

/// What has been sent and may still be copied; one for each user of a device.
class Uploads {
public:
    /// The context's device must outlive it.
    explicit Uploads(const DeviceContext& context);
    /// Waits for all that was sent, and until the context's queues are idle.
    ~Uploads();
    Uploads(const Uploads&) = delete;
    Uploads& operator=(const Uploads&) = delete;

    /// Reaches sent_value() when all is there. Who reads it on a queue waits for that.
    VkSemaphore timeline() const noexcept { return timeline_; }
    std::uint64_t sent_value() const noexcept { return sent_; }

    /// Waits here until all is there. Throws what vk_check() does.
    void wait();
    /// Whether all is there; false too where the device cannot say.
    bool is_done() noexcept;

private:
    friend class UploadBatch;

    struct StagedCopy {
        Buffer staging;
        VkBuffer target;
    };
    struct Sent {
        std::uint64_t value;
        OwnedCommandPool pool;
        std::vector<StagedCopy> copies;
    };

    void send(std::vector<StagedCopy>& copies);

    DeviceContext context_;
    OwnedSemaphore timeline_;
    std::uint64_t sent_ = 0;
    std::deque<Sent> in_flight_;
};

/// Buffers that are filled together. One that is not sent leaves nothing behind.
class UploadBatch {
public:
    explicit UploadBatch(const DeviceContext& context, Uploads& uploads)
        : context_(context), uploads_(uploads) {}

    /// A device buffer that will hold `data` when the batch is sent and the copies are done; it must stay
    /// until then. `data` is not needed afterwards. Throws as Buffer, and what vk_check() does: where more
    /// than k_max_staged_bytes have gathered they are sent and waited for.
    Buffer add(std::span<const std::byte> data, const std::string& what);
    template <typename T>
    Buffer add(std::span<const T> data, const std::string& what) {
        return add(std::as_bytes(data), what);
    }

    /// Begins to copy what was added. Does not wait. Throws what vk_check() does; nothing is copied then.
    void send();

    static constexpr std::uint64_t k_max_staged_bytes = std::uint64_t{64} << 20;

private:
    const DeviceContext& context_;
    Uploads& uploads_;
    std::vector<Uploads::StagedCopy> staged_;
    std::uint64_t staged_bytes_ = 0;
};

}  // namespace rimline
