#include "engine/passes/overlay_pass.h"

#include <algorithm>
#include <array>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "overlay_frag.h"
#include "overlay_vert.h"

namespace rimline {

namespace {

// The part of `scissor` inside the picture; empty if there is none.
VkRect2D cut(const VkRect2D& scissor, VkExtent2D extent) {
    const auto limit = [](std::int64_t value, std::uint32_t end) {
        return std::clamp<std::int64_t>(value, 0, end);
    };
    const std::int64_t x0 = limit(scissor.offset.x, extent.width);
    const std::int64_t y0 = limit(scissor.offset.y, extent.height);
    const std::int64_t x1 =
        limit(std::int64_t{scissor.offset.x} + scissor.extent.width, extent.width);
    const std::int64_t y1 =
        limit(std::int64_t{scissor.offset.y} + scissor.extent.height, extent.height);
    return {{static_cast<std::int32_t>(x0), static_cast<std::int32_t>(y0)},
            {static_cast<std::uint32_t>(x1 - x0), static_cast<std::uint32_t>(y1 - y0)}};
}

}  // namespace

OverlayPass::OverlayPass(const DeviceContext& context, VkFormat picture_format,
                         std::uint32_t ring_slots)
    : context_(context),
      images_(context, "overlay", 1, VK_FILTER_LINEAR),
      layout_(make_pipeline_layout(context, "overlay", sizeof(gpu::OverlayConstants),
                                   VK_SHADER_STAGE_VERTEX_BIT, {images_.layout()})),
      pipeline_(make_graphics_pipeline(context, "overlay",
                                       {.vertex = overlay_vert,
                                        .geometry = {},
                                        .fragment = overlay_frag,
                                        .formats = {.color = picture_format},
                                        .blend = Blend::over,
                                        .layout = layout_})),
      ring_(ring_slots) {
    constexpr std::uint8_t k_opaque = 255;
    set_texture(1, 1, {&k_opaque, 1});
}

void OverlayPass::set_texture(std::uint32_t width, std::uint32_t height,
                              std::span<const std::uint8_t> opacity) {
    RIMLINE_CHECK(opacity.size() == std::size_t{width} * height && !opacity.empty());
    Image texture(context_,
                  {.format = VK_FORMAT_R8_UNORM,
                   .extent = {width, height},
                   .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT},
                  "the letters of the panel");
    const Buffer staging(context_, opacity.size(), BufferPlace::upload, "the letters of the panel");
    std::memcpy(staging.mapped(), opacity.data(), opacity.size());
    run_commands(context_, [&](Commands commands) {
        constexpr StageAccess k_copying{VK_PIPELINE_STAGE_2_COPY_BIT,
                                        VK_ACCESS_2_TRANSFER_WRITE_BIT};
        record_barrier(
            commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE}, k_copying,
            {{texture, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL}});
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {width, height, 1}};
        commands->CmdCopyBufferToImage(commands, staging.handle(), texture.handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        record_barrier(
            commands, k_copying,
            {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT},
            {{texture, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}});
    });
    texture_ = std::move(texture);
    images_.set({&texture_});
}

void OverlayPass::record(Commands commands, std::uint32_t ring_slot, const OverlayDrawing& drawing,
                         VkExtent2D extent) {
    if (drawing.parts.empty()) return;
    const std::uint64_t vertex_bytes = drawing.vertices.size() * sizeof(gpu::OverlayVertex);
    const std::uint64_t index_bytes = drawing.indices.size() * sizeof(std::uint32_t);
    Buffer& buffer = ring_.at(ring_slot);
    grow(buffer, context_, vertex_bytes + index_bytes, BufferPlace::upload, "the panel");
    std::memcpy(buffer.mapped(), drawing.vertices.data(), vertex_bytes);
    std::memcpy(buffer.mapped() + vertex_bytes, drawing.indices.data(), index_bytes);

    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const VkDescriptorSet set = images_.get();
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set,
                                    0, nullptr);
    const VkViewport viewport{.width = static_cast<float>(extent.width),
                              .height = static_cast<float>(extent.height),
                              .minDepth = 0.0f,
                              .maxDepth = 1.0f};
    commands->CmdSetViewport(commands, 0, 1, &viewport);
    const gpu::OverlayConstants constants{.vertices = buffer.address(),
                                          .indices = buffer.address() + vertex_bytes,
                                          .origin = drawing.origin,
                                          .unit_size = drawing.unit_size};
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof constants,
                               &constants);
    for (const OverlayDrawing::Part& part : drawing.parts) {
        RIMLINE_CHECK(std::uint64_t{part.first_index} + part.index_count <= drawing.indices.size());
        const VkRect2D scissor = cut(part.scissor, extent);
        if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
        commands->CmdSetScissor(commands, 0, 1, &scissor);
        commands->CmdDraw(commands, part.index_count, 1, part.first_index, 0);
    }
}

}  // namespace rimline
