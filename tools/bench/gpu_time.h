#pragma once

// How long commands take: by the clock, around submitting and waiting, and by the device's own
// timestamps where it has them. On lavapipe trust the clock: its timestamps miss what threads still
// rasterize.

#include <functional>
#include <optional>

#include "engine/vulkan/device.h"
#include "engine/vulkan/query_pool.h"

namespace rimline::tools {

struct CommandTimes {
    double wall_ms = 0.0;
    std::optional<double> device_ms;  ///< Nothing where the queue family has no timestamps.
};

class CommandTimer {
public:
    explicit CommandTimer(const DeviceContext& context);

    /// Records, submits, waits. What `record` itself takes is in wall_ms.
    CommandTimes run(const std::function<void(VkCommandBuffer)>& record) const;

private:
    DeviceContext context_;
    std::uint32_t valid_bits_ = 0;
    double tick_ms_ = 0.0;
    QueryPool queries_;
};

}  // namespace rimline::tools
