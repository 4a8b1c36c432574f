#pragma once

// Divides the volumes of one light into batches, so that a stencil of eight bits never wraps from 255 to zero:
// each batch counts to at most 254, on top of the 1 that other batches may leave (shadow_volume_pass.h).
//
// What volumes count to is bounded (counted_volume.h), and bounds of several volumes add up. A volume whose bound
// is too large for a batch is divided into parts.

#include <cstdint>
#include <vector>

#include "engine/frame/counted_volume.h"
#include "engine/passes/draw_list.h"

namespace rimline {

/// The greatest count of a batch.
constexpr std::uint32_t k_batch_limit = 254;

/// Keeps its memory between calls. One thread at a time.
class ShadowBatches {
public:
    /// Adds volumes to the batches of a light. Call begin() before the first and end() after the last.
    void begin() noexcept;
    /// The volume of instance `instance`. Brings `count` up to it; `count` must live until end(), and the
    /// volume's spans too. Returns its bound. O(1) if `count` is of the same light and form, else as
    /// VolumeCounter::update().
    std::uint32_t add(std::uint32_t instance, const CountedVolume& volume, VolumeCount& count);
    /// A volume whose silhouette only the GPU knows. It is assumed to count to at most k_batch_limit. That is
    /// proven only for meshes of at most as many faces. moved_caster.h has the way to count others.
    std::uint32_t add_unseen(std::uint32_t instance, std::uint32_t face_count);
    /// A caster with all surfaces in its shadow: counted once everywhere, without a volume. Returns 1.
    std::uint32_t add_darkness(std::uint32_t instance);
    /// At least one batch; one alone if the bounds of all added volumes sum up to at most k_batch_limit. Divides
    /// volumes whose bounds are above it (VolumeCounter::divide()).
    std::vector<ShadowBatch> end();

private:
    struct Added {
        std::uint32_t instance;
        std::uint32_t bound;
        CountedVolume volume;
        VolumeCount* count;  // Null if unseen.
        bool is_darkness = false;
    };

    VolumeCounter counter_;
    std::vector<Added> added_;
};

}  // namespace rimline
