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
    const auto make = [&](bool has_shade, bool has_light, bool fades) {
        const std::array<std::uint32_t, 4> constants{number, has_shade, has_light, fades};
        return make_graphics_pipeline(
            context, {.vertex = surface_vert,
                      .geometry = {},
                      .fragment = surface_frag,
                      .fragment_constants = constants,
                      .formats = formats_,
                      .blend = has_shade ? Blend::replace : Blend::add,
                      .depth_compare = has_shade ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_EQUAL,
                      .depth_write = has_shade,
                      .stencil = has_shade ? StencilUse::off : StencilUse::zero,
                      .layout = layout_});
    };
    pipelines_.emplace(number,
                       Pipelines{.unlit = {make(true, false, false), make(true, false, true)},
                                 .lit = {make(false, true, false), make(false, true, true)},
                                 .shadowless = {make(true, true, false), make(true, true, true)}});
}

void SurfacePass::record(VkCommandBuffer commands, const DrawList& list,
                         const OwnedPipeline (&pipelines)[2],
                         std::optional<std::size_t> light) const {
    for (const DrawnInstance& instance : list.instances) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[instance.fades]);
        const DrawnLight* drawn = light ? &instance.lights[*light] : nullptr;
        push_draw_constants(commands, layout_, list, instance, drawn,
                            !drawn                ? 0
                            : drawn->casts_shadow ? 1
                                                  : 2);
        vkCmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
    }
}

void SurfacePass::record_unlit(VkCommandBuffer commands, const DrawList& list) const {
    record(commands, list, pipelines_.at(list.style).unlit, {});
}

void SurfacePass::record_lit(VkCommandBuffer commands, const DrawList& list,
                             std::size_t light) const {
    record(commands, list, pipelines_.at(list.style).lit, light);
}

void SurfacePass::record_shadowless(VkCommandBuffer commands, const DrawList& list) const {
    record(commands, list, pipelines_.at(list.style).shadowless, 0);
}

}  // namespace rimline
