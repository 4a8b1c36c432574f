#include "engine/stream/change_stream.h"

#include <algorithm>
#include <cstring>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/dispatch.h"
#include "scatter_comp.h"
#include "shaders/layout.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

static_assert(sizeof(SlotWrite) == sizeof(gpu::PlacedWrite));
static_assert(sizeof(WordWrite) == sizeof(gpu::PlacedWrite));
static_assert(sizeof(gpu::DrawArguments) == sizeof(VkDrawIndirectCommand) &&
              sizeof(gpu::SlotArguments) == 4 * sizeof(VkDrawIndirectCommand));

struct ScatterConstants {
    VkDeviceAddress slot_writes;
    VkDeviceAddress word_writes;
    VkDeviceAddress slots;
    VkDeviceAddress face_words;
    VkDeviceAddress arguments;
    std::uint32_t slot_write_count;
    std::uint32_t word_write_count;
    std::uint32_t silhouette_size;
    std::uint32_t padding;
};
static_assert(sizeof(ScatterConstants) == 56);

constexpr std::uint32_t k_group_size = 64;  // As in shaders/scatter.comp.

// The stages that may read, for which the changes are made visible.
constexpr StageAccess k_readers{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
        VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
// The stages that the next changes wait for. None of Rimline's fragment shaders reads a stream; with fragment shaders
// among them, the vertex shaders of each frame would wait for all fragments of the frame before.
constexpr StageAccess k_earlier_readers{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
        VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
        VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr StageAccess k_writers{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};

}  // namespace

ScatterPass::ScatterPass(const DeviceContext& context)
    : layout_(make_pipeline_layout(context, "change streams", sizeof(ScatterConstants),
                                   VK_SHADER_STAGE_COMPUTE_BIT)),
      pipeline_(make_compute_pipeline(context, "change streams", scatter_comp, layout_)) {}

StreamSize StreamSize::of(const Mesh& mesh) noexcept {
    return {.slots = mesh.edges_of_class(EdgeClass::border).first,
            .words = face_word_count(mesh.face_count())};
}

std::uint64_t StreamSize::state_bytes() const noexcept {
    return 4 * slots + std::uint64_t{4} * words + sizeof(gpu::SlotArguments);
}

std::uint64_t StreamSize::first_ring_bytes() const noexcept {
    constexpr std::uint64_t k_min_slots =
        4096;  // A ring slot begins with at least 16 KiB of slots.
    return std::max<std::uint64_t>(
        4 * (std::min(slots, std::max(slots / 8, k_min_slots)) + std::uint64_t{words}), 4);
}

std::uint64_t StreamSize::last_ring_bytes() const noexcept {
    return std::max<std::uint64_t>(4 * (slots + words), 4);
}

ChangeStream::ChangeStream(const DeviceContext& context, const StreamSize& size,
                           std::uint32_t ring_slots, MemoryBudget* budget, const std::string& model)
    : context_(context), size_(size), model_(model), share_(budget) {
    share_.resize(size.state_bytes(), "the silhouette slots of " + model);
    slots_ =
        Buffer(context, 4 * size.slots, BufferPlace::device, "the silhouette slots of " + model);
    face_words_ = Buffer(context, std::uint64_t{4} * size.words, BufferPlace::device,
                         "the face bits of " + model);
    arguments_ = Buffer(context, sizeof(gpu::SlotArguments), BufferPlace::device,
                        "the draw arguments of " + model);
    for (std::uint32_t i = 0; i < ring_slots; ++i) {
        RingSlot slot{.share = MemoryBudget::Share(budget), .data = {}};
        slot.share.resize(size.first_ring_bytes(), "the ring of change sets of " + model);
        slot.data = Buffer(context, size.first_ring_bytes(), BufferPlace::upload,
                           "the ring of change sets of " + model);
        ring_.push_back(std::move(slot));
    }
}

void ChangeStream::begin_frame(std::uint32_t ring_slot) {
    RIMLINE_CHECK(ring_slot < ring_.size());
    ring_slot_ = ring_slot;
    used_ = 0;
    batches_.clear();
}

std::uint64_t ChangeStream::size_bytes() const noexcept {
    std::uint64_t size = slots_.size() + face_words_.size() + arguments_.size();
    for (const RingSlot& slot : ring_) size += slot.data.size();
    return size;
}

// Makes this frame's ring slot at least `size_bytes` large. No other frame uses it.
void ChangeStream::reserve(std::uint64_t size_bytes) {
    RingSlot& slot = ring_[ring_slot_];
    if (size_bytes <= slot.data.size()) return;
    const std::string what = "the ring of change sets of " + model_;
    const std::uint64_t grown = std::min(std::max(size_bytes, slot.data.size() / 2 * 3),
                                         std::max(size_bytes, size_.last_ring_bytes()));
    if (used_ == 0) slot.data = {};  // Frees its memory before the larger one is made.
    try {
        slot.share.resize(grown, what);
        Buffer larger(context_, grown, BufferPlace::upload, what);
        if (used_ > 0) std::memcpy(larger.mapped(), slot.data.mapped(), used_);
        slot.data = std::move(larger);
    } catch (...) {
        slot.share.resize(slot.data.size(), what);
        throw;
    }
}

std::uint64_t ChangeStream::bytes_full() const noexcept {
    return std::uint64_t{4} * silhouette_size_ + std::uint64_t{4} * size_.words;
}

void ChangeStream::write(const void* data, std::uint64_t size_bytes) {
    if (size_bytes > 0) std::memcpy(ring().mapped() + used_, data, size_bytes);
    used_ += size_bytes;
}

bool ChangeStream::apply(const ChangeSet& changes) {
    if (!has_state_ || changes.sequence != sequence_ + 1) return false;
    if (changes.slots.empty() && changes.words.empty() &&
        changes.silhouette_size == silhouette_size_) {
        sequence_ = changes.sequence;
        return true;
    }
    const std::uint64_t full =
        std::uint64_t{4} * changes.silhouette_size + std::uint64_t{4} * size_.words;
    if (used_ + changes.slots.size_bytes() + changes.words.size_bytes() > full) return false;
    reserve(used_ + changes.slots.size_bytes() + changes.words.size_bytes());
    const Batch batch{.slot_offset = used_,
                      .word_offset = used_ + changes.slots.size_bytes(),
                      .slot_count = static_cast<std::uint32_t>(changes.slots.size()),
                      .word_count = static_cast<std::uint32_t>(changes.words.size()),
                      .silhouette_size = changes.silhouette_size,
                      .full = false};
    write(changes.slots.data(), changes.slots.size_bytes());
    write(changes.words.data(), changes.words.size_bytes());
    batches_.push_back(batch);
    sequence_ = changes.sequence;
    silhouette_size_ = changes.silhouette_size;
    return true;
}

void ChangeStream::resend(std::uint64_t sequence, std::span<const EdgeId> silhouette,
                          std::span<const std::uint32_t> face_words) {
    RIMLINE_CHECK(face_words.size() == size_.words && silhouette.size() <= size_.slots);
    used_ = 0;
    reserve(silhouette.size_bytes() + face_words.size_bytes());
    batches_.assign(1, {.slot_offset = 0,
                        .word_offset = silhouette.size_bytes(),
                        .slot_count = static_cast<std::uint32_t>(silhouette.size()),
                        .word_count = size_.words,
                        .silhouette_size = static_cast<std::uint32_t>(silhouette.size()),
                        .full = true});
    write(silhouette.data(), silhouette.size_bytes());
    write(face_words.data(), face_words.size_bytes());
    sequence_ = sequence;
    silhouette_size_ = static_cast<std::uint32_t>(silhouette.size());
    has_state_ = true;
}

void ChangeStream::record(Commands commands, const ScatterPass& pass) const {
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        const Batch& batch = batches_[i];
        // A later batch may write to the same place as an earlier one.
        if (i > 0) record_barrier(commands, k_writers, k_writers);
        if (batch.full) {
            const auto copy = [&](std::uint64_t offset, std::uint32_t count, const Buffer& target) {
                if (count == 0) return;
                const VkBufferCopy region{.srcOffset = offset, .size = std::uint64_t{4} * count};
                commands->CmdCopyBuffer(commands, ring().handle(), target.handle(), 1, &region);
            };
            copy(batch.slot_offset, batch.slot_count, slots_);
            copy(batch.word_offset, batch.word_count, face_words_);
        }
        const std::uint32_t slot_writes = batch.full ? 0 : batch.slot_count;
        const std::uint32_t word_writes = batch.full ? 0 : batch.word_count;
        const VkDeviceAddress data = ring().address();
        const ScatterConstants constants{data + batch.slot_offset,
                                         data + batch.word_offset,
                                         slots_.address(),
                                         face_words_.address(),
                                         arguments_.address(),
                                         slot_writes,
                                         word_writes,
                                         batch.silhouette_size,
                                         0};
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline_);
        commands->CmdPushConstants(commands, pass.layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   sizeof constants, &constants);
        // The shader loops with a stride, so any number of groups is right.
        const std::uint32_t groups = units_of(std::max(slot_writes, word_writes), k_group_size);
        commands->CmdDispatch(commands, std::clamp(groups, 1u, k_min_group_limit), 1, 1);
    }
}

void ChangeStream::record_before(Commands commands) {
    record_barrier(commands, k_earlier_readers, k_writers);
}

void ChangeStream::record_after(Commands commands) {
    record_barrier(commands, k_writers, k_readers);
}

}  // namespace rimline
