#include "engine/surface_pass.h"

#include <array>

#include "surface_frag.h"
#include "surface_vert.h"

namespace rimline {

SurfacePass::SurfacePass(const DeviceContext& context, const AttachmentFormats& formats)
    : formats_(formats),
      layout_(make_pipeline_layout(context, sizeof(gpu::DrawConstants), k_draw_stages)) {}

void SurfacePass::prepare(const DeviceContext& context, Style style) {
    const auto number = static_cast<std::uint32_t>(style);
    if (pipelines_.contains(number)) return;
    const auto make = [&](bool is_lit, bool fades) {
        const std::array<std::uint32_t, 3> constants{number, is_lit ? 1u : 0u, fades ? 1u : 0u};
        return make_graphics_pipeline(
            context, {.vertex = surface_vert,
                      .geometry = {},
                      .fragment = surface_frag,
                      .fragment_constants = constants,
                      .formats = formats_,
                      .blend = is_lit ? Blend::add : Blend::replace,
                      .depth_compare = is_lit ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER,
                      .depth_write = !is_lit,
                      .stencil = is_lit ? StencilUse::zero : StencilUse::off,
                      .layout = layout_});
    };
    pipelines_.emplace(number, Pipelines{.unlit = {make(false, false), make(false, true)},
                                         .lit = {make(true, false), make(true, true)}});
}

void SurfacePass::record_unlit(VkCommandBuffer commands, const DrawList& list) const {
    const Pipelines& pipelines = pipelines_.at(list.style);
    for (const DrawnInstance& instance : list.instances) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          pipelines.unlit[instance.fades]);
        push_draw_constants(commands, layout_, list, instance, nullptr, 0);
        vkCmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

void SurfacePass::record_lit(VkCommandBuffer commands, const DrawList& list,
                             std::size_t light) const {
    const Pipelines& pipelines = pipelines_.at(list.style);
    for (const DrawnInstance& instance : list.instances) {
        const DrawnLight& drawn = instance.lights[light];
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.lit[instance.fades]);
        push_draw_constants(commands, layout_, list, instance, &drawn, drawn.casts_shadow ? 1 : 2);
        vkCmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

}  // namespace rimline
