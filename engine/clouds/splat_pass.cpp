#include "engine/clouds/splat_pass.h"

#include "splat_frag.h"
#include "splat_vert.h"
#include "stroke_frag.h"
#include "stroke_vert.h"

namespace rimline {

namespace {

OwnedPipeline make_pipeline(const DeviceContext& context, const char* name, SpirvCode vertex,
                            SpirvCode fragment, const AttachmentFormats& formats,
                            VkPipelineLayout layout) {
    return make_graphics_pipeline(context, name,
                                  {.vertex = vertex,
                                   .geometry = {},
                                   .fragment = fragment,
                                   .formats = formats,
                                   .depth_compare = VK_COMPARE_OP_GREATER,
                                   .depth_write = true,
                                   .layout = layout});
}

}  // namespace

SplatPass::SplatPass(const DeviceContext& context, const AttachmentFormats& formats)
    : layout_(make_pipeline_layout(context, "clouds", sizeof(gpu::SplatConstants),
                                   VK_SHADER_STAGE_VERTEX_BIT)),
      splats_(make_pipeline(context, "discs of a cloud", splat_vert, splat_frag, formats, layout_)),
      strokes_(make_pipeline(context, "strokes of a cloud", stroke_vert, stroke_frag, formats,
                             layout_)) {}

void SplatPass::record(Commands commands, const gpu::SplatConstants& constants,
                       std::uint32_t splat_count, std::uint32_t stroke_count) const {
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof constants,
                               &constants);
    if (splat_count > 0) {
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, splats_);
        commands->CmdDraw(commands, 6, splat_count, 0, 0);
    }
    if (stroke_count > 0) {
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, strokes_);
        commands->CmdDraw(commands, 6, stroke_count, 0, 0);
    }
}

}  // namespace rimline
