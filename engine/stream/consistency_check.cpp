#include "engine/stream/consistency_check.h"

#include <array>
#include <bit>

#include "engine/vulkan/barrier.h"
#include "shaders/slot_arguments.h"

namespace rimline {

namespace {

// As change streams write (change_stream.cpp), in this frame and in the next.
constexpr StageAccess k_written{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr StageAccess k_copied{VK_PIPELINE_STAGE_2_COPY_BIT,
                               VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
// The host reads the copies; the next frame writes what was copied.
constexpr StageAccess k_after{k_written.stages | VK_PIPELINE_STAGE_2_HOST_BIT,
                              k_written.access | VK_ACCESS_2_HOST_READ_BIT};

std::uint64_t copied_bytes(const SilhouetteSnapshot& state) {
    return sizeof(gpu::SlotArguments) + sizeof(EdgeId) * state.slots.size() +
           sizeof(std::uint32_t) * state.words.size();
}

// Counts the elements that differ between `expected` and the bytes at `first`, and advances `first`.
template <typename Word>
std::uint64_t count_differences(const std::byte*& first, std::span<const Word> expected) {
    std::uint64_t count = 0;
    for (const Word& word : expected) {
        count += std::memcmp(first, &word, sizeof(Word)) != 0;
        first += sizeof(Word);
    }
    return count;
}

}  // namespace

void ConsistencyCheck::record(Commands commands, std::uint32_t ring_slot,
                              std::span<TrackedSilhouette* const> silhouettes) {
    Frame& frame = frames_[ring_slot];
    frame.expected.resize(silhouettes.size());
    std::uint64_t size = 0;
    for (std::size_t i = 0; i < silhouettes.size(); ++i) {
        silhouettes[i]->read_tracker(frame.expected[i]);
        size += copied_bytes(frame.expected[i]);
    }
    grow(frame.copies, context_, size, BufferPlace::readback, "the copy to check");

    record_barrier(commands, k_written, k_copied);
    VkDeviceSize offset = 0;
    const auto copy = [&](const Buffer& from, VkDeviceSize bytes) {
        if (bytes == 0) return;
        const VkBufferCopy region{.dstOffset = offset, .size = bytes};
        commands->CmdCopyBuffer(commands, from.handle(), frame.copies.handle(), 1, &region);
        offset += bytes;
    };
    for (std::size_t i = 0; i < silhouettes.size(); ++i) {
        const ChangeStream& stream = silhouettes[i]->stream();
        copy(stream.arguments(), sizeof(gpu::SlotArguments));
        copy(stream.slots(), sizeof(EdgeId) * frame.expected[i].slots.size());
        copy(stream.face_words(), sizeof(std::uint32_t) * frame.expected[i].words.size());
    }
    record_barrier(commands, k_copied, k_after);
}

std::uint64_t ConsistencyCheck::take_differences(std::uint32_t ring_slot) {
    Frame& frame = frames_[ring_slot];
    const std::byte* at = frame.copies.mapped();
    std::uint64_t count = 0;
    for (const SilhouetteSnapshot& state : frame.expected) {
        const auto size = static_cast<std::uint32_t>(state.slots.size());
        const auto arguments =
            std::bit_cast<std::array<std::uint32_t, sizeof(gpu::SlotArguments) / 4>>(
                gpu::slot_arguments(size));
        count += count_differences(at, std::span<const std::uint32_t>(arguments));
        count += count_differences(at, std::span<const EdgeId>(state.slots));
        count += count_differences(at, std::span<const std::uint32_t>(state.words));
    }
    frame.expected.clear();
    return count;
}

}  // namespace rimline
