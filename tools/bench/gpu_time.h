#pragma once

// The time of commands: by the clock, around submitting and waiting, and by the device's timestamps where
// it has them. On lavapipe only the clock is right: the timestamps miss the work of threads that still
// rasterize.

#include <functional>
#include <optional>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/query_pool.h"
#include "engine/vulkan/timestamps.h"

namespace rimline::tools {

struct CommandTimes {
    double wall_ms = 0.0;
    std::optional<double> device_ms;  ///< Nothing where the queue family has no timestamps.
};

class CommandTimer {
public:
    explicit CommandTimer(const DeviceContext& context);

    /// Records, submits and waits. wall_ms includes the time of `record`.
    CommandTimes run(const std::function<void(Commands)>& record) const;

private:
    DeviceContext context_;
    TimestampUnit unit_;
    QueryPool queries_;
};

}  // namespace rimline::tools
