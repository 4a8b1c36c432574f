#include "engine/composite_pass.h"

#include "composite_frag.h"
#include "composite_vert.h"

namespace rimline {

namespace {

struct Constants {
    glm::vec4 ink;
    std::int32_t scale;
};

}  // namespace

CompositePass::CompositePass(const DeviceContext& context, VkFormat picture_format)
    : images_(context, 2),
      layout_(make_pipeline_layout(context, sizeof(Constants), VK_SHADER_STAGE_FRAGMENT_BIT,
                                   images_.layout())),
      pipeline_(make_graphics_pipeline(context, {.vertex = composite_vert,
                                                 .geometry = {},
                                                 .fragment = composite_frag,
                                                 .formats = {.color = picture_format},
                                                 .layout = layout_})) {}

void CompositePass::record(VkCommandBuffer commands, const glm::vec4& ink,
                           std::uint32_t scale) const {
    const Constants constants{ink, static_cast<std::int32_t>(scale)};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const VkDescriptorSet set = images_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                            nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                       &constants);
    vkCmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
