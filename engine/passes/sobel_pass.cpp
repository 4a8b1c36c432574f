#include "engine/passes/sobel_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "composite_vert.h"
#include "sobel_frag.h"

namespace rimline {

SobelPass::SobelPass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                     VkFormat surface_format)
    : shapes_(context, "shapes for outlines", 1),
      layout_(make_pipeline_layout(context, "outlines", sizeof(gpu::SobelConstants),
                                   VK_SHADER_STAGE_FRAGMENT_BIT, {draw_data, shapes_.layout()})),
      pipeline_(make_graphics_pipeline(context, "outlines",
                                       {.vertex = composite_vert,
                                        .geometry = {},
                                        .fragment = sobel_frag,
                                        .formats = {.color = surface_format},
                                        .blend = Blend::maximum_alpha,
                                        .layout = layout_})) {}

void SobelPass::record(Commands commands, const DrawList& list, const Outline& outline,
                       float width_px, const VkRect2D& drawn) const {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const std::array sets{list.data, shapes_.get()};
    constexpr std::array<std::uint32_t, 2>
        k_offsets{};  // Of instances and lights, which it does not read.
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0,
                                    sets.size(), sets.data(), k_offsets.size(), k_offsets.data());
    const gpu::SobelConstants constants{
        .low_x = drawn.offset.x,
        .low_y = drawn.offset.y,
        .high_x = drawn.offset.x + static_cast<std::int32_t>(drawn.extent.width) - 1,
        .high_y = drawn.offset.y + static_cast<std::int32_t>(drawn.extent.height) - 1,
        .reach = std::max(1, static_cast<std::int32_t>(std::lround(0.5f * width_px))),
        .depth_step = outline.depth_step,
        .normal_step = outline.normal_step_deg < 180.0f
                           ? 2.0f * std::sin(glm::radians(0.5f * outline.normal_step_deg))
                           : std::numeric_limits<float>::max()};
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                               &constants);
    commands->CmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
