#pragma once

// The GPU's copy of one tracker's state, kept up to date by change sets.
//
//     ChangeSet --memcpy--> ring (mapped) --scatter.comp--> slots, face words, draw arguments
//
// Writes are scattered in parallel, for a change set names each place once. Bytes a frame are
// proportional to what changed. Where that would pass a full rewrite, or a change set was missed, the
// whole state is sent: slots in use, 4 bytes each, and all words.
//
// A ring slot belongs to one frame in flight: the caller names the slot, and has waited until the GPU
// is done with the frame that used it last.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory.h"
#include "engine/pipeline.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The compute pass that scatters; one serves every stream of a device.
class ScatterPass {
public:
    explicit ScatterPass(const DeviceContext& context);

private:
    friend class ChangeStream;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

class ChangeStream {
public:
    /// Room for any silhouette of `mesh`. Its state is empty until the first resend().
    ChangeStream(const DeviceContext& context, const Mesh& mesh, std::uint32_t ring_slots);

    /// Forgets what the GPU holds: only resend() will do next. For a frame that was queued and never
    /// ran.
    void invalidate() noexcept { has_state_ = false; }

    /// Opens ring slot `ring_slot` for a new frame.
    void begin_frame(std::uint32_t ring_slot);

    /// Queues a change set. False, and nothing queued, where only resend() will do: the sequence has a
    /// gap, or the whole state is smaller.
    [[nodiscard]] bool apply(const ChangeSet& changes);

    /// Queues the whole state; what was queued this frame before is dropped.
    void resend(std::uint64_t sequence, std::span<const EdgeId> silhouette,
                std::span<const std::uint32_t> face_words);

    /// Records copies and scatters of what was queued. Surround it with record_before() and
    /// record_after(), once for all streams of a frame.
    void record(VkCommandBuffer commands, const ScatterPass& pass) const;
    static void record_before(VkCommandBuffer commands);
    static void record_after(VkCommandBuffer commands);

    /// Bytes queued in this frame, and what sending the whole state would have cost.
    std::uint64_t bytes_streamed() const noexcept { return used_; }
    std::uint64_t bytes_full() const noexcept;
    std::uint32_t silhouette_size() const noexcept { return silhouette_size_; }

    /// For a caller's own shaders: slots hold edge numbers, words hold face bits, and the arguments
    /// (VkDrawIndirectCommand) draw one point a slot in use.
    const Buffer& slots() const noexcept { return slots_; }
    const Buffer& face_words() const noexcept { return face_words_; }
    const Buffer& arguments() const noexcept { return arguments_; }

private:
    // Parts of the ring slot's data, as offsets from its beginning.
    struct Batch {
        std::uint64_t slot_offset, word_offset;
        std::uint32_t slot_count, word_count;
        std::uint32_t silhouette_size;
        bool full;  // Plain values to copy, not writes to scatter.
    };

    std::uint64_t ring_offset() const noexcept { return ring_slot_ * slot_capacity_; }
    std::byte* write(const void* data, std::uint64_t size_bytes);

    std::uint32_t word_count_;
    std::uint64_t slot_capacity_;  // Bytes of a ring slot: the greatest whole state.
    Buffer ring_;
    Buffer slots_;
    Buffer face_words_;
    Buffer arguments_;
    std::uint64_t ring_slot_ = 0;
    std::uint64_t used_ = 0;
    std::uint64_t sequence_ = 0;
    bool has_state_ = false;
    std::uint32_t silhouette_size_ = 0;
    std::vector<Batch> batches_;
};

}  // namespace rimline
