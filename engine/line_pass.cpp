#include "engine/line_pass.h"

#include "line_frag.h"
#include "line_geom.h"
#include "points_vert.h"

namespace rimline {

LinePass::LinePass(const DeviceContext& context, VkFormat coverage_format)
    : depth_(context, 1),
      layout_(make_pipeline_layout(context, sizeof(gpu::DrawConstants), k_draw_stages,
                                   depth_.layout())),
      pipeline_(make_graphics_pipeline(context, {.vertex = points_vert,
                                                 .geometry = line_geom,
                                                 .fragment = line_frag,
                                                 .topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST,
                                                 .formats = {.color = coverage_format},
                                                 .blend = Blend::maximum,
                                                 .layout = layout_})) {}

void LinePass::record(VkCommandBuffer commands, const DrawList& list) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    const VkDescriptorSet set = depth_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0,
                            nullptr);
    for (const DrawnInstance& instance : list.instances) {
        if (!instance.has_lines) continue;
        push_draw_constants(commands, layout_, list, instance, nullptr, 0);
        vkCmdDrawIndirect(commands, instance.silhouette.arguments, 0, 1,
                          sizeof(VkDrawIndirectCommand));
        if (instance.border_count == 0) continue;
        push_draw_constants(commands, layout_, list, instance, nullptr, 1);
        vkCmdDraw(commands, instance.border_count, 1, 0, 0);
    }
}

}  // namespace rimline
