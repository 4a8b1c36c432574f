#pragma once

// Tells which recorded frames the GPU is done with, independent of who submitted them: the last command of a
// frame writes the frame's number to memory that the host reads.
//
// A renderer inside another one has no fence of its own. It relies on its caller to know when a frame is
// done; the marks let it detect a caller that is wrong.

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"

namespace rimline {

class FrameMarks {
public:
    /// For frames in `slots` ring slots. Each slot has one mark, of its last frame.
    FrameMarks(const DeviceContext& context, std::uint32_t slots);

    /// Records the mark `frame_number`, not 0, of `slot`, written when all earlier commands are done.
    void record(Commands commands, std::uint32_t slot, std::uint64_t frame_number) const;

    /// Whether the mark of `slot` is that of `frame_number`.
    bool has(std::uint32_t slot, std::uint64_t frame_number) const noexcept;

private:
    Buffer marks_;
};

}  // namespace rimline
