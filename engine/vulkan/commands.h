#pragma once

// Command pools and buffers, timelines, and commands that run at once.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

/// A timeline semaphore at 0.
OwnedSemaphore make_timeline(const DeviceContext& context);
/// Waits until `timeline` reaches `value`. Throws what vk_check() does.
void wait_for_timeline(const DeviceContext& context, VkSemaphore timeline, std::uint64_t value);
/// For a queue of `family`. Its command buffers can be reset one by one.
OwnedCommandPool make_command_pool(const DeviceContext& context, std::uint32_t family);
/// A command buffer of `pool`, begun, to be submitted once. It is freed with the pool.
VkCommandBuffer begin_commands(const DeviceContext& context, VkCommandPool pool);

/// Records commands, submits them, and waits until they are done. For setup, not for frames. Throws what
/// vk_check() does; then too, everything that the commands use may be freed.
void run_commands(const DeviceContext& context, const std::function<void(VkCommandBuffer)>& record);

}  // namespace rimline
