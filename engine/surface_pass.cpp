#include "engine/surface_pass.h"

#include "surface_frag.h"
#include "surface_vert.h"

namespace rimline {

SurfacePass::SurfacePass(const DeviceContext& context, const AttachmentFormats& formats)
    : layout_(make_pipeline_layout(context, sizeof(gpu::DrawConstants), k_draw_stages)) {
    GraphicsPipelineDescription description{.vertex = surface_vert,
                                            .geometry = {},
                                            .fragment = surface_frag,
                                            .formats = formats,
                                            .depth_compare = VK_COMPARE_OP_GREATER,
                                            .depth_write = true,
                                            .layout = layout_};
    unlit_ = make_graphics_pipeline(context, description);
    description.blend = Blend::add;
    description.depth_compare = VK_COMPARE_OP_EQUAL;
    description.depth_write = false;
    description.stencil = StencilUse::zero;
    lit_ = make_graphics_pipeline(context, description);
}

void SurfacePass::record_unlit(VkCommandBuffer commands, const DrawList& list) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, unlit_);
    for (const DrawnInstance& instance : list.instances) {
        push_draw_constants(commands, layout_, list, instance, nullptr, 0);
        vkCmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

void SurfacePass::record_lit(VkCommandBuffer commands, const DrawList& list,
                             std::size_t light) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, lit_);
    for (const DrawnInstance& instance : list.instances) {
        const DrawnLight& drawn = instance.lights[light];
        push_draw_constants(commands, layout_, list, instance, &drawn, drawn.casts_shadow ? 1 : 2);
        vkCmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

}  // namespace rimline
