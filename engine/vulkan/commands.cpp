#include "engine/vulkan/commands.h"

#include "engine/vulkan/barrier.h"

namespace rimline {

OwnedSemaphore make_timeline(const DeviceContext& context) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                     .pNext = &type};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk_check(vkCreateSemaphore(context.device, &info, nullptr, &semaphore), "vkCreateSemaphore");
    return {context.device, semaphore};
}

void wait_for_timeline(const DeviceContext& context, VkSemaphore timeline, std::uint64_t value) {
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &timeline,
                                   .pValues = &value};
    vk_check(repeat_wait([&] { return vkWaitSemaphores(context.device, &info, UINT64_MAX); }),
             "vkWaitSemaphores");
}

OwnedCommandPool make_command_pool(const DeviceContext& context, std::uint32_t family) {
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = family};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateCommandPool(context.device, &info, nullptr, &pool), "vkCreateCommandPool");
    return {context.device, pool};
}

VkCommandBuffer begin_commands(const DeviceContext& context, VkCommandPool pool) {
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk_check(vkAllocateCommandBuffers(context.device, &allocate, &commands),
             "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    return commands;
}

void run_commands(const DeviceContext& context,
                  const std::function<void(VkCommandBuffer)>& record) {
    const OwnedCommandPool pool = make_command_pool(context, context.queue_family);
    const VkCommandBuffer commands = begin_commands(context, pool);
    record(commands);
    // Waiting for the queue does not make writes visible to later submissions. This barrier does.
    record_barrier(commands, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
    vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkCommandBufferSubmitInfo submitted{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                              .commandBuffer = commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &submitted};
    vk_check(vkQueueSubmit2(context.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    vk_check(repeat_wait([&] { return vkQueueWaitIdle(context.queue); }), "vkQueueWaitIdle");
}

}  // namespace rimline
