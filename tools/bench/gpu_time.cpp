#include "tools/bench/gpu_time.h"
#include "engine/vulkan/commands.h"

#include <array>
#include <chrono>

namespace rimline::tools {

CommandTimer::CommandTimer(const DeviceContext& context)
    : context_(context),
      unit_(timestamp_unit(context)),
      queries_(context, VK_QUERY_TYPE_TIMESTAMP, 2, "times of commands") {}

CommandTimes CommandTimer::run(const std::function<void(Commands)>& record) const {
    const auto start = std::chrono::steady_clock::now();
    run_commands(context_, [&](Commands commands) {
        if (unit_.valid_bits == 0) return record(commands);
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
    if (unit_.valid_bits == 0) return times;
    std::array<std::uint64_t, 2> ticks{};
    queries_.read(ticks);
    times.device_ms = unit_.elapsed_ms(ticks[0], ticks[1]);
    return times;
}

}  // namespace rimline::tools
