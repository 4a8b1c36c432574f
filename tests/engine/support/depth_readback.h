#pragma once

// The depth and the stencil of a picture, read back after a frame (Renderer::targets()).

#include <cstdint>
#include <vector>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "engine/vulkan/memory.h"

namespace rimline::tests {

/// One value for each pixel of `depth`, which is read-only: of the aspect whose values are T. Leaves it as it was.
template <typename T>
std::vector<T> read_aspect(const DeviceContext& context, const Image& depth,
                           VkImageAspectFlagBits aspect) {
    const VkExtent2D extent = depth.description().extent;
    const std::size_t pixels = std::size_t{extent.width} * extent.height;
    const Buffer buffer(context, pixels * sizeof(T), BufferPlace::readback, "one aspect of depth");
    constexpr StageAccess k_all{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT};
    constexpr StageAccess k_copy{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    constexpr VkImageLayout k_read_only = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout k_source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    run_commands(context, [&](Commands commands) {
        record_barrier(commands, k_all, k_copy, {{depth, k_read_only, k_source}});
        const VkBufferImageCopy region{
            .imageSubresource = {static_cast<VkImageAspectFlags>(aspect), 0, 0, 1},
            .imageExtent = {extent.width, extent.height, 1}};
        commands->CmdCopyImageToBuffer(commands, depth.handle(), k_source, buffer.handle(), 1,
                                       &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        record_barrier(commands, k_copy, k_all, {{depth, k_source, k_read_only}});
    });
    const auto* values = reinterpret_cast<const T*>(buffer.mapped());
    return {values, values + pixels};
}

inline std::vector<std::uint8_t> read_stencil(const DeviceContext& context, const Image& depth) {
    return read_aspect<std::uint8_t>(context, depth, VK_IMAGE_ASPECT_STENCIL_BIT);
}
inline std::vector<float> read_depth(const DeviceContext& context, const Image& depth) {
    return read_aspect<float>(context, depth, VK_IMAGE_ASPECT_DEPTH_BIT);
}

}  // namespace rimline::tests
