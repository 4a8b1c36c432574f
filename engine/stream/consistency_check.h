#pragma once

// Checks that the GPU's state equals the trackers'. At the end of a frame the slots in use, face bits and
// draw arguments of its silhouettes are copied to the host, and compared with the trackers' own state, which
// did not pass through change sets and streams.
//
// For debugging and for tests: each frame reads back the whole state of its silhouettes.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/stream/tracked_silhouette.h"
#include "engine/vulkan/functions.h"

namespace rimline {

class ConsistencyCheck {
public:
    /// For frames in `ring_slots` ring slots.
    ConsistencyCheck(const DeviceContext& context, std::uint32_t ring_slots)
        : context_(context), frames_(ring_slots) {}

    /// Records the copies, at the end of the frame, and keeps copies of the trackers' states. Nothing may
    /// have been announced since the silhouettes were followed, and the GPU must be done with the frame that
    /// used `ring_slot` before. Throws what Buffer does.
    void record(Commands commands, std::uint32_t ring_slot,
                std::span<TrackedSilhouette* const> silhouettes);

    /// The number of words that differ in the frame of `ring_slot`, which the GPU is done with. Forgets the
    /// frame: returns 0 the next time, and if nothing was recorded.
    std::uint64_t take_differences(std::uint32_t ring_slot);

    /// Forgets the frame of `ring_slot`, which never ran.
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
