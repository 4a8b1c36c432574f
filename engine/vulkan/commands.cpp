#include "engine/vulkan/commands.h"

#include <chrono>
#include <thread>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/debug_names.h"

namespace rimline {

OwnedSemaphore make_timeline(const DeviceContext& context, const std::string& name) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                     .pNext = &type};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk_check(context.vk->CreateSemaphore(context.device, &info, nullptr, &semaphore),
             "vkCreateSemaphore");
    set_name(*context.vk, VK_OBJECT_TYPE_SEMAPHORE, semaphore, name);
    return {context, semaphore};
}

void wait_for_timeline(const DeviceContext& context, VkSemaphore timeline, std::uint64_t value) {
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &timeline,
                                   .pValues = &value};
    vk_check(
        repeat_wait([&] { return context.vk->WaitSemaphores(context.device, &info, UINT64_MAX); }),
        "vkWaitSemaphores");
}

OwnedFence make_fence(const DeviceContext& context, VkFenceCreateFlags flags) {
    const VkFenceCreateInfo info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .flags = flags};
    VkFence fence = VK_NULL_HANDLE;
    vk_check(context.vk->CreateFence(context.device, &info, nullptr, &fence), "vkCreateFence");
    return {context, fence};
}

void wait_for_fence(const DeviceContext& context, VkFence fence) {
    vk_check(repeat_wait([&] {
                 return context.vk->WaitForFences(context.device, 1, &fence, VK_TRUE, UINT64_MAX);
             }),
             "vkWaitForFences");
}

bool is_signaled(const DeviceContext& context, VkFence fence) {
    const VkResult result = context.vk->WaitForFences(context.device, 1, &fence, VK_TRUE, 0);
    if (result == VK_TIMEOUT) return false;
    vk_check(result, "vkWaitForFences");
    return true;
}

OwnedCommandPool make_command_pool(const DeviceContext& context, const std::string& name,
                                   std::uint32_t family) {
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = family};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(context.vk->CreateCommandPool(context.device, &info, nullptr, &pool),
             "vkCreateCommandPool");
    set_name(*context.vk, VK_OBJECT_TYPE_COMMAND_POOL, pool, name);
    return {context, pool};
}

VkCommandBuffer make_commands(const DeviceContext& context, VkCommandPool pool) {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk_check(context.vk->AllocateCommandBuffers(context.device, &info, &commands),
             "vkAllocateCommandBuffers");
    return commands;
}

Commands begin_commands(const DeviceContext& context, VkCommandBuffer commands) {
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(context.vk->ResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
    vk_check(context.vk->BeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    return {*context.vk, commands};
}

QueueLock::QueueLock(const DeviceContext& context) : mutex_(context.queue_mutex) {
    if (mutex_) mutex_->lock();
}

QueueLock::~QueueLock() {
    if (mutex_) mutex_->unlock();
}

void submit_commands(const DeviceContext& context, const Submission& submission) {
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = submission.commands};
    const auto info_of = [](const SemaphorePoint& point) {
        return VkSemaphoreSubmitInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = point.semaphore,
                                     .value = point.value,
                                     .stageMask = point.stages};
    };
    std::vector<VkSemaphoreSubmitInfo> waits;
    for (const SemaphorePoint& wait : submission.waits) waits.push_back(info_of(wait));
    VkSemaphoreSubmitInfo signal{};
    if (submission.signal) signal = info_of(*submission.signal);
    const VkSubmitInfo2 info{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size()),
        .pWaitSemaphoreInfos = waits.data(),
        .commandBufferInfoCount = submission.commands != VK_NULL_HANDLE ? 1u : 0u,
        .pCommandBufferInfos = &commands,
        .signalSemaphoreInfoCount = submission.signal ? 1u : 0u,
        .pSignalSemaphoreInfos = &signal};
    const QueueLock lock(context);
    vk_check(context.vk->QueueSubmit2(submission.queue, 1, &info, submission.fence),
             "vkQueueSubmit2");
}

void drain(const DeviceContext& context, VkQueue queue) noexcept {
    // Submissions to a queue end in order where semaphores or fences are signaled.
    for (int attempt = 0; attempt < 1000; ++attempt) {
        try {
            const OwnedFence fence = make_fence(context);
            submit_commands(context, {.queue = queue, .fence = fence});
            wait_for_fence(context, fence);
            return;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::too_large) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
}

void run_commands(const DeviceContext& context, const std::function<void(Commands)>& record,
                  const UploadPoint& uploaded) {
    const OwnedCommandPool pool =
        make_command_pool(context, "commands that run at once", context.queue_family);
    const OwnedFence done = make_fence(context);
    const Commands commands = begin_commands(context, make_commands(context, pool));
    record(commands);
    // Waiting for a fence does not make writes visible to later submissions. This barrier does.
    record_barrier(commands, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    Submission submission{.queue = context.queue, .commands = commands, .fence = done};
    if (uploaded.value > 0) submission.waits.push_back(uploaded);
    submit_commands(context, submission);
    wait_for_fence(context, done);
}

}  // namespace rimline
