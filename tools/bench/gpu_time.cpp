#include "tools/bench/gpu_time.h"

#include <array>
#include <chrono>
#include <vector>

namespace rimline::tools {

CommandTimer::CommandTimer(const DeviceContext& context) : context_(context) {
    std::uint32_t family_count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(context.physical_device, &family_count, nullptr);
    std::vector<VkQueueFamilyProperties> families(family_count);
    vkGetPhysicalDeviceQueueFamilyProperties(context.physical_device, &family_count,
                                             families.data());
    valid_bits_ = families.at(context.queue_family).timestampValidBits;
    tick_ms_ = double{context.limits.timestampPeriod} * 1e-6;
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2};
    VkQueryPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateQueryPool(context.device, &info, nullptr, &pool), "vkCreateQueryPool");
    queries_ = {context.device, pool};
}

CommandTimes CommandTimer::run(const std::function<void(VkCommandBuffer)>& record) const {
    const auto start = std::chrono::steady_clock::now();
    run_commands(context_, [&](VkCommandBuffer commands) {
        if (valid_bits_ == 0) return record(commands);
        vkCmdResetQueryPool(commands, queries_, 0, 2);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 0);
        record(commands);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 1);
    });
    CommandTimes times{.wall_ms = std::chrono::duration<double, std::milli>(
                                      std::chrono::steady_clock::now() - start)
                                      .count(),
                       .device_ms = {}};
    if (valid_bits_ == 0) return times;
    std::array<std::uint64_t, 2> ticks{};
    vk_check(
        vkGetQueryPoolResults(context_.device, queries_, 0, 2, sizeof ticks, ticks.data(),
                              sizeof ticks[0], VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
    const std::uint64_t mask =
        valid_bits_ >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits_) - 1;
    times.device_ms = tick_ms_ * static_cast<double>((ticks[1] - ticks[0]) & mask);
    return times;
}

}  // namespace rimline::tools
