#include "engine/passes/shadow_color_pass.h"

#include "composite_vert.h"
#include "shadow_color_frag.h"

namespace rimline {

ShadowColorPass::ShadowColorPass(const DeviceContext& context, const AttachmentFormats& formats)
    : formats_(formats),
      colors_(context, "colors of shadows", 1),
      layout_(make_pipeline_layout(context, "colors of shadows", 0, 0, {colors_.layout()})) {}

void ShadowColorPass::prepare(const DeviceContext& context) {
    if (is_prepared()) return;
    pipeline_ = make_graphics_pipeline(context, "surfaces, in shadow",
                                       {.vertex = composite_vert,
                                        .geometry = {},
                                        .fragment = shadow_color_frag,
                                        .formats = formats_,
                                        .stencil = StencilUse::not_zero,
                                        .layout = layout_});
}

void ShadowColorPass::record(Commands commands) const {
    const VkDescriptorSet set = colors_.get();
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set,
                                    0, nullptr);
    commands->CmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
