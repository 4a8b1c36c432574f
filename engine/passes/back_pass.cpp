#include "engine/passes/back_pass.h"

#include <cmath>

#include "back_frag.h"
#include "back_vert.h"

namespace rimline {

BackPass::BackPass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                   const AttachmentFormats& formats)
    : layout_(make_pipeline_layout(context, "backs", sizeof(gpu::DrawConstants), k_draw_stages,
                                   {draw_data})),
      pipeline_(make_graphics_pipeline(context, "backs",
                                       {.vertex = back_vert,
                                        .geometry = {},
                                        .fragment = back_frag,
                                        .formats = formats,
                                        .depth_compare = VK_COMPARE_OP_GREATER,
                                        .depth_write = true,
                                        .layout = layout_})) {}

// The rectangle has room for half of the width.
std::int32_t BackPass::reach_px(const Scene& scene) {
    return 1 + static_cast<std::int32_t>(std::ceil(0.5f * scene.line_width_px));
}

void BackPass::record(Commands commands, const DrawList& list, bool is_layer) const {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    for (const DrawnInstance& instance : list.instances) {
        if (!instance.has_lines) continue;
        set_draw(commands, layout_, list, instance, nullptr, is_layer ? 1 : 0);
        commands->CmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

}  // namespace rimline
