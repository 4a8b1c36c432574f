#include "engine/passes/surface_pass.h"

#include <array>

#include "engine/vulkan/descriptor_sets.h"

#include "held_out_frag.h"
#include "surface_colored_frag.h"
#include "surface_colored_shadowed_frag.h"
#include "surface_colored_vert.h"
#include "surface_frag.h"
#include "surface_shadowed_frag.h"
#include "surface_textured_frag.h"
#include "surface_textured_shadowed_frag.h"
#include "surface_textured_vert.h"
#include "surface_unlit_vert.h"
#include "surface_vert.h"

namespace rimline {

namespace {

void bind(Commands commands, VkPipeline pipeline, const DrawnInstance& instance) {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    commands->CmdSetCullMode(commands,
                             instance.shows_backs ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
}

}  // namespace

SurfacePass::SurfacePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                         const AttachmentFormats& formats)
    : formats_(formats),
      texture_(make_set_layout(context, "texture", {&k_texture_binding, 1})),
      layout_(make_pipeline_layout(context, "surfaces", sizeof(gpu::DrawConstants), k_draw_stages,
                                   {draw_data, texture_})) {}

void SurfacePass::prepare(const DeviceContext& context, const SurfaceKind& kind) {
    if (pipelines_.contains(kind)) return;
    const bool is_held_out = kind.output == SurfaceOutput::held_out;
    const bool is_beside_shadow = kind.lights == SurfaceLights::beside_shadow;
    SpirvCode corners = surface_vert;
    SpirvCode shading =
        is_beside_shadow ? SpirvCode(surface_shadowed_frag) : SpirvCode(surface_frag);
    if (is_held_out) shading = held_out_frag;
    if (kind.colors == SurfaceColors::mesh) {
        corners = surface_colored_vert;
        shading = is_beside_shadow ? SpirvCode(surface_colored_shadowed_frag)
                                   : SpirvCode(surface_colored_frag);
    } else if (kind.colors == SurfaceColors::textures) {
        corners = surface_textured_vert;
        shading = is_beside_shadow ? SpirvCode(surface_textured_shadowed_frag)
                                   : SpirvCode(surface_textured_frag);
    }
    AttachmentFormats formats = formats_;
    if (is_beside_shadow) formats.color_count = 2;
    const StencilUse lit = is_held_out ? StencilUse::not_zero : StencilUse::zero;
    const auto make = [&](bool has_shade, bool has_light, SpirvCode vertex, bool fills = false) {
        const std::array<std::uint32_t, 6> constants{
            kind.style, has_shade, has_light, kind.fades, kind.output == SurfaceOutput::layer,
            fills};
        const Blend filled =
            kind.filling == SurfaceFilling::darker ? Blend::darker : Blend::lighter;
        const Blend added = fills ? filled : Blend::add;
        return make_graphics_pipeline(
            context,
            has_shade && has_light ? "surfaces, whole"
            : has_shade            ? "surfaces, unlit"
                                   : "surfaces, lit",
            {.vertex = vertex,
             .geometry = {},
             .fragment = shading,
             .fragment_constants = constants,
             .formats = formats,
             .blend = has_shade ? Blend::replace : added,
             .depth_compare = has_shade ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_EQUAL,
             .depth_write = has_shade,
             .stencil = has_shade ? StencilUse::off : lit,
             .sets_cull = true,
             .layout = layout_});
    };
    Pipelines pipelines;
    if (kind.lights == SurfaceLights::apart) {
        pipelines.unlit = make(true, false, kind.shades_vertices ? surface_unlit_vert : corners);
        pipelines.lit = make(false, true, corners);
        if (kind.filling != SurfaceFilling::none)
            pipelines.filled = make(false, true, corners, true);
    } else {
        pipelines.whole = make(true, true, corners);
    }
    pipelines_.emplace(kind, std::move(pipelines));
}

// Of all faces that can be seen, with their corners one by one.
void SurfacePass::draw_corners(Commands commands, const DrawList& list,
                               const DrawnInstance& instance) const {
    if (instance.corner_count > 0) {
        commands->CmdBindIndexBuffer(commands, list.corners, 0, VK_INDEX_TYPE_UINT32);
        commands->CmdDrawIndexed(commands, instance.corner_count, 1, instance.first_corner, 0, 0);
        return;
    }
    if (instance.surface.colors != SurfaceColors::textures) {
        commands->CmdDraw(commands, 3 * instance.face_count, 1, 0, 0);
        return;
    }
    for (const TexturedFaces& faces : instance.textured_faces) {
        commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 1, 1,
                                        &faces.texture, 0, nullptr);
        commands->CmdDraw(commands, 3 * faces.face_count, 1, 3 * faces.first_face, 0);
    }
}

void SurfacePass::record(Commands commands, const DrawList& list,
                         OwnedPipeline Pipelines::*pipeline, std::size_t light) const {
    for (const DrawnInstance& instance : list.instances) {
        const DrawnLight& drawn = instance.lights[light];
        const bool fills = drawn.fills && instance.surface.filling != SurfaceFilling::none;
        if (fills && instance.surface.filling == SurfaceFilling::left_out) continue;
        bind(commands, pipelines_.at(instance.surface).*(fills ? &Pipelines::filled : pipeline),
             instance);
        set_draw(commands, layout_, list, instance, &drawn, drawn.casts_shadow ? 1 : 0);
        draw_corners(commands, list, instance);
    }
}

void SurfacePass::record_unlit(Commands commands, const DrawList& list) const {
    for (const DrawnInstance& instance : list.instances) {
        bind(commands, pipelines_.at(instance.surface).unlit, instance);
        set_draw(commands, layout_, list, instance, nullptr, 0);
        if (instance.surface.shades_vertices) {
            commands->CmdBindIndexBuffer(commands, instance.indices, 0, VK_INDEX_TYPE_UINT32);
            commands->CmdDrawIndexed(commands, 3 * instance.face_count, 1, 0, 0, 0);
        } else {
            draw_corners(commands, list, instance);
        }
    }
}

void SurfacePass::record_lit(Commands commands, const DrawList& list, std::size_t light) const {
    record(commands, list, &Pipelines::lit, light);
}

void SurfacePass::record_whole(Commands commands, const DrawList& list) const {
    record(commands, list, &Pipelines::whole, 0);
}

}  // namespace rimline
