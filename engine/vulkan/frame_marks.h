#pragma once

// Which recorded frames the GPU is done with, whoever submitted them: the last command of a frame
// writes its number where the host reads it.
//
// A renderer inside another one has no fence of its own. It takes its caller's word for when a frame is
// done, and with the marks it can tell when that word does not hold.

#include "engine/vulkan/memory.h"

namespace rimline {

class FrameMarks {
public:
    /// For frames in `slots` ring slots; a slot's mark is that of the last frame there.
    FrameMarks(const DeviceContext& context, std::uint32_t slots);

    /// Marks `frame_number`, not 0, in `slot` once all commands recorded before are done.
    void record(VkCommandBuffer commands, std::uint32_t slot, std::uint64_t frame_number) const;

    bool has(std::uint32_t slot, std::uint64_t frame_number) const noexcept;

private:
    Buffer marks_;
};

}  // namespace rimline
