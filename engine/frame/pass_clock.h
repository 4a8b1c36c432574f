#pragma once

// The times of a frame's passes on the GPU (FrameReport::passes). A timestamp is written at the start of a
// frame and at the end of each pass; the time of a pass lies between two of them:
//
//     start | silhouettes | surfaces .. | lines |   (another command buffer)   start_again | picture |
//     t0    t1            t2            t3                                      t4           t5
//
// Each timestamp waits for all earlier commands. So passes that the GPU could overlap are counted one after
// the other, and the sum is the time from the first to the last.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame_report.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/query_pool.h"
#include "engine/vulkan/timestamps.h"

namespace rimline {

class PassClock {
public:
    /// For frames in `slots` ring slots. It does nothing, and has no queries, where `is_on` is false or the
    /// queue family has no timestamps.
    PassClock(const DeviceContext& context, std::uint32_t slots, bool is_on);

    /// Begins the frame of `slot`, with at most `pass_count` passes and one start_again(). Nothing may use the
    /// slot's frame before. Outside a render pass. Throws what vk_check() does.
    void start(Commands commands, std::uint32_t slot, std::uint32_t pass_count);
    /// The time since the previous call belongs to no pass.
    void start_again(Commands commands);
    /// The time since the previous call is that of the pass `name`, for one light where there is one.
    void end_pass(Commands commands, const char* name, std::optional<std::size_t> light = {});

    /// The passes of the frame of `slot`, once. Never waits. Empty where the frame was forgotten or its
    /// timestamps are not there yet.
    std::vector<PassTime> take(std::uint32_t slot);
    /// The frame of `slot` will never run.
    void forget(std::uint32_t slot) noexcept;

private:
    struct Slot {
        QueryPool queries;
        std::uint32_t query_count = 0;
        std::vector<std::string>
            names;  // Of the timestamps written. Empty: what ends there is no pass.
    };
    void stamp(Commands commands, std::string name);

    DeviceContext context_;
    TimestampUnit unit_;
    std::vector<Slot> slots_;  // Empty: off.
    std::uint32_t current_ = 0;
};

}  // namespace rimline
