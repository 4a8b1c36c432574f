#pragma once

// Whether the GPU holds what the trackers say: at the end of a frame the slots in use, face bits and draw
// arguments of its silhouettes are copied to the host, and compared with the trackers' own state, which
// went no way through change sets or streams.
//
// For looking into a doubt, and for tests: a frame costs what all its silhouettes cost whole.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/stream/tracked_silhouette.h"

namespace rimline {

class ConsistencyCheck {
public:
    /// For frames in `ring_slots` ring slots.
    ConsistencyCheck(const DeviceContext& context, std::uint32_t ring_slots)
        : context_(context), frames_(ring_slots) {}

    /// Records the copies, after all that the frame does, and keeps the trackers' states: nothing may
    /// have been announced since the silhouettes were followed. The GPU must be done with the frame that
    /// was in `ring_slot`. Throws what Buffer does.
    void record(VkCommandBuffer commands, std::uint32_t ring_slot,
                std::span<TrackedSilhouette* const> silhouettes);

    /// Words that differ in the frame of `ring_slot`, which the GPU is done with. Forgets the frame: 0
    /// the next time, and where nothing was recorded.
    std::uint64_t take_differences(std::uint32_t ring_slot);

    /// The frame of `ring_slot` never ran.
    void forget(std::uint32_t ring_slot) noexcept { frames_[ring_slot].expected.clear(); }

private:
    struct Frame {
        std::vector<SilhouetteSnapshot> expected;  // One for each silhouette, in the copies' order.
        Buffer copies;
    };
    DeviceContext context_;
    std::vector<Frame> frames_;
};

}  // namespace rimline
