#include "engine/composite_pass.h"

#include "composite_frag.h"
#include "composite_vert.h"

namespace rimline {

namespace {

struct Constants {
    CompositeColors colors;
    std::int32_t scale;
    std::uint32_t encodes_srgb;
};

}  // namespace

CompositePass::CompositePass(const DeviceContext& context)
    : images_(context, 2),
      layout_(make_pipeline_layout(context, sizeof(Constants), VK_SHADER_STAGE_FRAGMENT_BIT,
                                   images_.layout())) {}

void CompositePass::prepare(const DeviceContext& context, VkFormat format) {
    if (pipelines_.contains(format)) return;
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(context.physical_device, format, &properties);
    if (encoding_of(format) == PictureEncoding::impossible ||
        (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) == 0)
        throw Error(ErrorCode::bad_input,
                    "pictures cannot be drawn in VkFormat " + std::to_string(format));
    pipelines_.emplace(format, make_graphics_pipeline(context, {.vertex = composite_vert,
                                                                .geometry = {},
                                                                .fragment = composite_frag,
                                                                .formats = {.color = format},
                                                                .layout = layout_}));
}

void CompositePass::record(VkCommandBuffer commands, VkFormat format, const CompositeColors& colors,
                           std::uint32_t scale) const {
    const Constants constants{colors, static_cast<std::int32_t>(scale),
                              encoding_of(format) == PictureEncoding::srgb};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.at(format));
    const VkDescriptorSet set = images_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                            nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                       &constants);
    vkCmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
