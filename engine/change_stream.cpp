#include "engine/change_stream.h"

#include <algorithm>
#include <cstring>

#include "engine/barrier.h"
#include "scatter_comp.h"
#include "shaders/layout.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

static_assert(sizeof(SlotWrite) == sizeof(gpu::PlacedWrite));
static_assert(sizeof(WordWrite) == sizeof(gpu::PlacedWrite));
static_assert(sizeof(gpu::DrawArguments) == sizeof(VkDrawIndirectCommand));

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

std::uint64_t slot_count_of(const Mesh& mesh) {
    return mesh.edges_of_class(EdgeClass::border).first;
}

constexpr StageAccess k_readers{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
        VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
constexpr StageAccess k_writers{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};

}  // namespace

ScatterPass::ScatterPass(const DeviceContext& context)
    : layout_(make_pipeline_layout(context, sizeof(ScatterConstants), VK_SHADER_STAGE_COMPUTE_BIT)),
      pipeline_(make_compute_pipeline(context, scatter_comp, layout_)) {}

ChangeStream::ChangeStream(const DeviceContext& context, const Mesh& mesh, std::uint32_t ring_slots)
    : word_count_(face_word_count(mesh.face_count())),
      slot_capacity_(std::max<std::uint64_t>(4 * (slot_count_of(mesh) + word_count_), 4)),
      ring_(context, slot_capacity_ * ring_slots, BufferPlace::upload, "the ring of change sets"),
      slots_(context, 4 * slot_count_of(mesh), BufferPlace::device, "silhouette slots"),
      face_words_(context, std::uint64_t{4} * word_count_, BufferPlace::device, "face bits"),
      arguments_(context, sizeof(gpu::DrawArguments), BufferPlace::device, "draw arguments") {}

void ChangeStream::begin_frame(std::uint32_t ring_slot) {
    RIMLINE_CHECK((ring_slot + 1) * slot_capacity_ <= ring_.size());
    ring_slot_ = ring_slot;
    used_ = 0;
    batches_.clear();
}

std::uint64_t ChangeStream::bytes_full() const noexcept {
    return std::uint64_t{4} * silhouette_size_ + std::uint64_t{4} * word_count_;
}

std::byte* ChangeStream::write(const void* data, std::uint64_t size_bytes) {
    std::byte* target = ring_.mapped() + ring_offset() + used_;
    if (size_bytes > 0) std::memcpy(target, data, size_bytes);
    used_ += size_bytes;
    return target;
}

bool ChangeStream::apply(const ChangeSet& changes) {
    if (!has_state_ || changes.sequence != sequence_ + 1) return false;
    const std::uint64_t full =
        std::uint64_t{4} * changes.silhouette_size + std::uint64_t{4} * word_count_;
    if (used_ + changes.slots.size_bytes() + changes.words.size_bytes() > full) return false;
    Batch batch{.slot_offset = used_,
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
    RIMLINE_CHECK(face_words.size() == word_count_);
    RIMLINE_CHECK(silhouette.size_bytes() + face_words.size_bytes() <= slot_capacity_);
    used_ = 0;
    batches_.assign(1, {.slot_offset = 0,
                        .word_offset = silhouette.size_bytes(),
                        .slot_count = static_cast<std::uint32_t>(silhouette.size()),
                        .word_count = word_count_,
                        .silhouette_size = static_cast<std::uint32_t>(silhouette.size()),
                        .full = true});
    write(silhouette.data(), silhouette.size_bytes());
    write(face_words.data(), face_words.size_bytes());
    sequence_ = sequence;
    silhouette_size_ = static_cast<std::uint32_t>(silhouette.size());
    has_state_ = true;
}

void ChangeStream::record(VkCommandBuffer commands, const ScatterPass& pass) const {
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        const Batch& batch = batches_[i];
        // A later batch may name a place of an earlier one.
        if (i > 0) record_barrier(commands, k_writers, k_writers);
        if (batch.full) {
            const auto copy = [&](std::uint64_t offset, std::uint32_t count, const Buffer& target) {
                if (count == 0) return;
                const VkBufferCopy region{.srcOffset = ring_offset() + offset,
                                          .size = std::uint64_t{4} * count};
                vkCmdCopyBuffer(commands, ring_.handle(), target.handle(), 1, &region);
            };
            copy(batch.slot_offset, batch.slot_count, slots_);
            copy(batch.word_offset, batch.word_count, face_words_);
        }
        const std::uint32_t slot_writes = batch.full ? 0 : batch.slot_count;
        const std::uint32_t word_writes = batch.full ? 0 : batch.word_count;
        const VkDeviceAddress data = ring_.address() + ring_offset();
        const ScatterConstants constants{data + batch.slot_offset,
                                         data + batch.word_offset,
                                         slots_.address(),
                                         face_words_.address(),
                                         arguments_.address(),
                                         slot_writes,
                                         word_writes,
                                         batch.silhouette_size,
                                         0};
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline_);
        vkCmdPushConstants(commands, pass.layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                           &constants);
        // The shader strides, so any number of groups is right; 65535 exist everywhere.
        const std::uint32_t groups = (std::max(slot_writes, word_writes) + 63) / 64;
        vkCmdDispatch(commands, std::clamp(groups, 1u, 65535u), 1, 1);
    }
}

void ChangeStream::record_before(VkCommandBuffer commands) {
    record_barrier(commands, k_readers, k_writers);
}

void ChangeStream::record_after(VkCommandBuffer commands) {
    record_barrier(commands, k_writers, k_readers);
}

}  // namespace rimline
