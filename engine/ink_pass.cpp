#include "engine/ink_pass.h"

#include "composite_vert.h"
#include "ink_frag.h"

namespace rimline {

namespace {

struct Constants {
    CompositeColors colors;
    std::int32_t scale;
};

}  // namespace

InkPass::InkPass(const DeviceContext& context, VkFormat surface_format)
    : lines_(context, 1),
      layout_(make_pipeline_layout(context, sizeof(Constants), VK_SHADER_STAGE_FRAGMENT_BIT,
                                   {lines_.layout()})),
      pipeline_(make_graphics_pipeline(context, {.vertex = composite_vert,
                                                 .geometry = {},
                                                 .fragment = ink_frag,
                                                 .formats = {.color = surface_format},
                                                 .blend = Blend::over,
                                                 .layout = layout_})) {}

void InkPass::record(VkCommandBuffer commands, const CompositeColors& colors,
                     std::uint32_t scale) const {
    const Constants constants{colors, static_cast<std::int32_t>(scale)};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const VkDescriptorSet set = lines_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                            nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                       &constants);
    vkCmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
