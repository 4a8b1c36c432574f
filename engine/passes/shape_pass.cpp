#include "engine/passes/shape_pass.h"

#include "shape_frag.h"
#include "surface_vert.h"

namespace rimline {

ShapePass::ShapePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                     const AttachmentFormats& formats)
    : layout_(make_pipeline_layout(context, "shapes", sizeof(gpu::DrawConstants), k_draw_stages,
                                   {draw_data})),
      pipeline_(make_graphics_pipeline(context, "shapes",
                                       {.vertex = surface_vert,
                                        .geometry = {},
                                        .fragment = shape_frag,
                                        .formats = formats,
                                        .depth_compare = VK_COMPARE_OP_GREATER,
                                        .depth_write = true,
                                        .sets_cull = true,
                                        .layout = layout_})) {}

void ShapePass::record(Commands commands, const DrawList& list) const {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    for (const DrawnInstance& instance : list.instances) {
        commands->CmdSetCullMode(commands,
                                 instance.shows_backs ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
        set_draw(commands, layout_, list, instance, nullptr,
                 instance.has_lines ? RIMLINE_SHAPE_OUTLINED : RIMLINE_SHAPE_HIDING);
        commands->CmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

}  // namespace rimline
