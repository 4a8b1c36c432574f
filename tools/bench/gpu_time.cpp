#include "tools/bench/gpu_time.h"
#include "engine/vulkan/commands.h"

#include <array>
#include <chrono>
#include <vector>

namespace rimline::tools {

CommandTimer::CommandTimer(const DeviceContext& context) : context_(context) {
    std::uint32_t family_count = 0;
    context.vk->GetPhysicalDeviceQueueFamilyProperties(context.physical_device, &family_count,
                                                       nullptr);
    std::vector<VkQueueFamilyProperties> families(family_count);
    context.vk->GetPhysicalDeviceQueueFamilyProperties(context.physical_device, &family_count,
                                                       families.data());
    valid_bits_ = families.at(context.queue_family).timestampValidBits;
    tick_ms_ = double{context.limits.timestampPeriod} * 1e-6;
    queries_ = QueryPool(context, VK_QUERY_TYPE_TIMESTAMP, 2);
}

CommandTimes CommandTimer::run(const std::function<void(Commands)>& record) const {
    const auto start = std::chrono::steady_clock::now();
    run_commands(context_, [&](Commands commands) {
        if (valid_bits_ == 0) return record(commands);
        queries_.record_reset(commands);
        commands->CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                     queries_.handle(), 0);
        record(commands);
        commands->CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                     queries_.handle(), 1);
    });
    CommandTimes times{.wall_ms = std::chrono::duration<double, std::milli>(
                                      std::chrono::steady_clock::now() - start)
                                      .count(),
                       .device_ms = {}};
    if (valid_bits_ == 0) return times;
    std::array<std::uint64_t, 2> ticks{};
    queries_.read(ticks);
    const std::uint64_t mask =
        valid_bits_ >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits_) - 1;
    times.device_ms = tick_ms_ * static_cast<double>((ticks[1] - ticks[0]) & mask);
    return times;
}

}  // namespace rimline::tools
