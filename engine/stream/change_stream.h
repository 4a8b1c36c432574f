#pragma once

// The GPU's copy of one tracker's state, kept up to date by change sets.
//
//     ChangeSet --memcpy--> ring (mapped) --scatter.comp--> slots, face words, draw arguments
//
// Writes are scattered in parallel, because a change set names each place once. The bytes of a frame are
// proportional to the number of changes. If they exceeded the whole state, or if a change set was missed, the
// whole state is sent: slots in use and all words, 4 bytes each.
//
// A ring slot belongs to one frame in flight. The caller names the slot, after the GPU is done with the frame
// that used it last.
//
// The slots' buffer holds every edge that can be on a silhouette. Ring slots are smaller: few silhouettes are
// that large, and there are several ring slots. They begin with space for an eighth of the edges. One that is
// too small for its frame is replaced by a larger one.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The compute pass that scatters. All streams of a device share one.
class ScatterPass {
public:
    explicit ScatterPass(const DeviceContext& context);

private:
    friend class ChangeStream;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

/// The size of a stream: the slots that a silhouette can fill, and the words of face bits.
struct StreamSize {
    std::uint64_t slots = 0;
    std::uint32_t words = 0;

    static StreamSize of(const Mesh& mesh) noexcept;
    /// Bytes of the state on the GPU.
    std::uint64_t state_bytes() const noexcept;
    /// Bytes of a ring slot at first, and after a silhouette of all edges has been sent whole.
    std::uint64_t first_ring_bytes() const noexcept;
    std::uint64_t last_ring_bytes() const noexcept;
    /// Bytes of a new stream. It grows to at most state_bytes() + ring_slots * last_ring_bytes().
    std::uint64_t first_bytes(std::uint32_t ring_slots) const noexcept {
        return state_bytes() + ring_slots * first_ring_bytes();
    }
};

class ChangeStream {
public:
    /// Its state is empty until the first resend(). All its allocations, also later ones, count in `budget`,
    /// which must outlive it; null for none. Messages name `model`. Throws Error{too_large} naming the
    /// budget, or the device's limit.
    ChangeStream(const DeviceContext& context, const StreamSize& size, std::uint32_t ring_slots,
                 MemoryBudget* budget = nullptr, const std::string& model = "the model");
    /// For any silhouette of `mesh`, without a budget.
    ChangeStream(const DeviceContext& context, const Mesh& mesh, std::uint32_t ring_slots)
        : ChangeStream(context, StreamSize::of(mesh), ring_slots) {}

    /// Declares the GPU's state unknown: the next frame must use resend(). For a frame that was queued and
    /// never ran.
    void invalidate() noexcept { has_state_ = false; }

    /// Opens ring slot `ring_slot` for a new frame.
    void begin_frame(std::uint32_t ring_slot);

    /// Queues a change set. Returns false and queues nothing if resend() is needed: the sequence has a gap,
    /// or the whole state is smaller. Throws Error{too_large} if the ring slot cannot grow, as resend() does;
    /// call invalidate() then.
    [[nodiscard]] bool apply(const ChangeSet& changes);

    /// Queues the whole state, in place of everything queued in this frame before.
    void resend(std::uint64_t sequence, std::span<const EdgeId> silhouette,
                std::span<const std::uint32_t> face_words);

    /// Whether anything was queued in this frame.
    bool has_changes() const noexcept { return !batches_.empty(); }

    /// Records copies and scatters of the queued changes. Call record_before() before it and record_after()
    /// after it, once for all streams of a frame; none of the three is needed where no stream has changes.
    /// record_before() waits for reads as indirect arguments, by copies, and by all shaders but those of
    /// fragments. record_after() makes the changes visible to indirect draws and to all shaders.
    void record(Commands commands, const ScatterPass& pass) const;
    static void record_before(Commands commands);
    static void record_after(Commands commands);

    /// Bytes of buffers.
    std::uint64_t size_bytes() const noexcept;
    /// Bytes queued in this frame, and bytes of the whole state.
    std::uint64_t bytes_streamed() const noexcept { return used_; }
    std::uint64_t bytes_full() const noexcept;
    std::uint32_t silhouette_size() const noexcept { return silhouette_size_; }

    /// For a caller's own shaders: slots hold edge numbers, words hold face bits, and the arguments
    /// (gpu::SlotArguments) draw the slots in use as points, as strips of four vertices, or as the sides of
    /// shadow volumes.
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

    struct RingSlot {
        MemoryBudget::Share share;
        Buffer data;
    };

    const Buffer& ring() const noexcept { return ring_[ring_slot_].data; }
    void reserve(std::uint64_t size_bytes);
    void write(const void* data, std::uint64_t size_bytes);

    DeviceContext context_;
    StreamSize size_;
    std::string model_;
    MemoryBudget::Share share_;  // Of everything but the ring.
    std::vector<RingSlot> ring_;
    Buffer slots_;
    Buffer face_words_;
    Buffer arguments_;
    std::uint32_t ring_slot_ = 0;
    std::uint64_t used_ = 0;
    std::uint64_t sequence_ = 0;
    bool has_state_ = false;
    std::uint32_t silhouette_size_ = 0;
    std::vector<Batch> batches_;
};

}  // namespace rimline
