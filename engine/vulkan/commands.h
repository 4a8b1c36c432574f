#pragma once

// Command pools and buffers, timelines, submissions, and commands that run at once.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/upload_point.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

// Names are for debug_names.h.

/// A timeline semaphore at 0.
OwnedSemaphore make_timeline(const DeviceContext& context, const std::string& name);
/// Waits until `timeline` reaches `value`. Throws what vk_check() does.
void wait_for_timeline(const DeviceContext& context, VkSemaphore timeline, std::uint64_t value);
OwnedFence make_fence(const DeviceContext& context, VkFenceCreateFlags flags = 0);
/// Waits until `fence` is signaled. Throws what vk_check() does.
void wait_for_fence(const DeviceContext& context, VkFence fence);
/// Whether `fence` is signaled now. Throws what vk_check() does.
bool is_signaled(const DeviceContext& context, VkFence fence);

/// For a queue of `family`. Its command buffers can be reset one by one.
OwnedCommandPool make_command_pool(const DeviceContext& context, const std::string& name,
                                   std::uint32_t family);
/// A command buffer of `pool`, with which it is freed.
VkCommandBuffer make_commands(const DeviceContext& context, VkCommandPool pool);
/// Resets `commands` and begins them, to be submitted once.
Commands begin_commands(const DeviceContext& context, VkCommandBuffer commands);

/// A semaphore and its value, which is ignored for a binary one.
struct SemaphorePoint {
    SemaphorePoint(VkSemaphore of, std::uint64_t to = 0,
                   VkPipelineStageFlags2 at = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)
        : semaphore(of), value(to), stages(at) {}
    SemaphorePoint(const UploadPoint& uploaded)
        : SemaphorePoint(uploaded.timeline, uploaded.value) {}

    VkSemaphore semaphore;
    std::uint64_t value;
    VkPipelineStageFlags2 stages;
};

struct Submission {
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandBuffer commands =
        VK_NULL_HANDLE;  ///< Null: none, for the semaphores and the fence alone.
    std::vector<SemaphorePoint> waits;
    std::optional<SemaphorePoint> signal;
    VkFence fence = VK_NULL_HANDLE;
};

/// Holds the lock of a context's queues while it lives.
class QueueLock {
public:
    explicit QueueLock(const DeviceContext& context);
    ~QueueLock();
    QueueLock(const QueueLock&) = delete;
    QueueLock& operator=(const QueueLock&) = delete;

private:
    QueueMutex* mutex_;
};

/// Submits, under the lock of the context's queues. Throws what vk_check() does; then nothing was submitted.
void submit_commands(const DeviceContext& context, const Submission& submission);

/// Waits until `queue` has done everything that was submitted to it before. Unlike
/// vkQueueWaitIdle, it uses the queue, and holds its lock, only to submit.
/// Returns on a lost device too, and where memory has run out.
void drain(const DeviceContext& context, VkQueue queue) noexcept;

/// Records commands, submits them after what was uploaded, and waits until they are done. For setup, not for
/// frames. Throws what vk_check() does; then too, everything that the commands use may be freed.
void run_commands(const DeviceContext& context, const std::function<void(Commands)>& record,
                  const UploadPoint& uploaded = {});

}  // namespace rimline
