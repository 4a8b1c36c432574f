#include "engine/frame/draw_data.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "engine/passes/draw_list.h"
#include "engine/vulkan/rounding.h"

namespace rimline {

namespace {

constexpr VkDescriptorSetLayoutBinding binding(std::uint32_t number, VkDescriptorType type) {
    return {.binding = number,
            .descriptorType = type,
            .descriptorCount = 1,
            .stageFlags = k_draw_stages};
}

constexpr std::array k_bindings{binding(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
                                binding(1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC),
                                binding(2, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC)};

}  // namespace

DrawData::DrawData(const DeviceContext& context, std::uint32_t frames_in_flight)
    : context_(context),
      sets_(context, "draw data", k_bindings, frames_in_flight),
      buffers_(frames_in_flight),
      segments_(frames_in_flight),
      corners_(frames_in_flight),
      parts_(frames_in_flight) {}

std::uint32_t DrawData::padded(std::size_t size_bytes) const noexcept {
    return static_cast<std::uint32_t>(
        rounded_up<VkDeviceSize>(size_bytes, context_.limits.minUniformBufferOffsetAlignment));
}

void DrawData::begin_frame(std::uint32_t slot, const gpu::FrameData& frame, std::size_t instances,
                           std::size_t lights) {
    slot_ = slot;
    end_ = padded(sizeof frame);
    // Space for at least one instance: descriptors must lie within the buffer. A light is no larger.
    static_assert(sizeof(gpu::LightData) <= sizeof(gpu::InstanceData));
    const VkDeviceSize size =
        VkDeviceSize{padded(sizeof frame)} +
        VkDeviceSize{std::max<std::size_t>(instances, 1)} * padded(sizeof(gpu::InstanceData)) +
        VkDeviceSize{lights} * padded(sizeof(gpu::LightData));
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::too_large, "a scene's " + std::to_string(instances) +
                                              " instances and their lights are more than 4 GiB");
    Buffer& buffer = buffers_[slot];
    if (grow(buffer, context_, size, BufferPlace::upload, "frame data")) {
        const std::array sizes{sizeof frame, sizeof(gpu::InstanceData), sizeof(gpu::LightData)};
        std::array<VkDescriptorBufferInfo, k_bindings.size()> infos;
        std::array<VkWriteDescriptorSet, k_bindings.size()> writes;
        for (std::uint32_t i = 0; i < k_bindings.size(); ++i) {
            infos[i] = {.buffer = buffer.handle(), .offset = 0, .range = sizes[i]};
            writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                         .dstSet = sets_[slot],
                         .dstBinding = i,
                         .descriptorCount = 1,
                         .descriptorType = k_bindings[i].descriptorType,
                         .pBufferInfo = &infos[i]};
        }
        context_.vk->UpdateDescriptorSets(context_.device, writes.size(), writes.data(), 0,
                                          nullptr);
    }
    std::memcpy(buffer.mapped(), &frame, sizeof frame);
}

VkDeviceAddress DrawData::put_segments(std::span<const gpu::LineSegment> segments) {
    if (segments.empty()) return 0;
    Buffer& buffer = segments_[slot_];
    grow(buffer, context_, segments.size_bytes(), BufferPlace::upload, "lines");
    std::memcpy(buffer.mapped(), segments.data(), segments.size_bytes());
    return buffer.address();
}

DrawData::CornerList DrawData::make_corner_list(std::size_t corners) {
    if (corners == 0) return {};
    Buffer& buffer = corners_[slot_];
    const VkDeviceSize size = VkDeviceSize{corners} * sizeof(std::uint32_t);
    grow(buffer, context_, size, BufferPlace::upload, "corners of fronts");
    return {{reinterpret_cast<std::uint32_t*>(buffer.mapped()), corners}, buffer.handle()};
}

DrawData::PartLists DrawData::make_part_lists(std::size_t sides, std::size_t faces) {
    if (faces == 0) return {};
    Buffer& buffer = parts_[slot_];
    const VkDeviceSize sides_size = VkDeviceSize{sides} * sizeof(gpu::EdgeRecord);
    const VkDeviceSize size = sides_size + VkDeviceSize{faces} * sizeof(std::uint32_t);
    grow(buffer, context_, size, BufferPlace::upload, "parts of shadow volumes");
    return {{reinterpret_cast<gpu::EdgeRecord*>(buffer.mapped()), sides},
            {reinterpret_cast<std::uint32_t*>(buffer.mapped() + sides_size), faces},
            buffer.address(),
            buffer.address() + sides_size};
}

}  // namespace rimline
