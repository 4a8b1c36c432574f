#include "engine/shadow_volume_pass.h"

#include "points_vert.h"
#include "shadow_caps_vert.h"
#include "shadow_sides_geom.h"

namespace rimline {

namespace {

// A ray that leaves the picture behind the surface crosses as many back faces of a volume as front
// faces, but for one more back face if it starts inside.
void set_counting(VkCommandBuffer commands, bool turned_round) {
    const VkStencilOp front =
        turned_round ? VK_STENCIL_OP_INCREMENT_AND_WRAP : VK_STENCIL_OP_DECREMENT_AND_WRAP;
    const VkStencilOp back =
        turned_round ? VK_STENCIL_OP_DECREMENT_AND_WRAP : VK_STENCIL_OP_INCREMENT_AND_WRAP;
    vkCmdSetStencilOp(commands, VK_STENCIL_FACE_FRONT_BIT, VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP,
                      front, VK_COMPARE_OP_ALWAYS);
    vkCmdSetStencilOp(commands, VK_STENCIL_FACE_BACK_BIT, VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP,
                      back, VK_COMPARE_OP_ALWAYS);
}

}  // namespace

ShadowVolumePass::ShadowVolumePass(const DeviceContext& context, const AttachmentFormats& formats)
    : layout_(make_pipeline_layout(context, sizeof(gpu::DrawConstants), k_draw_stages)) {
    GraphicsPipelineDescription description{.vertex = shadow_caps_vert,
                                            .geometry = {},
                                            .fragment = {},
                                            .formats = formats,
                                            .blend = Blend::none_written,
                                            .depth_compare = VK_COMPARE_OP_GREATER,
                                            .depth_clamp = true,
                                            .stencil = StencilUse::count,
                                            .layout = layout_};
    caps_ = make_graphics_pipeline(context, description);
    description.vertex = points_vert;
    description.geometry = shadow_sides_geom;
    description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    sides_ = make_graphics_pipeline(context, description);
}

void ShadowVolumePass::record(VkCommandBuffer commands, const DrawList& list, std::size_t light,
                              VkExtent2D extent) const {
    const VkClearAttachment stencil{.aspectMask = VK_IMAGE_ASPECT_STENCIL_BIT,
                                    .clearValue = {.depthStencil = {0.0f, 0}}};
    const VkClearRect everywhere{.rect = {{0, 0}, extent}, .layerCount = 1};
    vkCmdClearAttachments(commands, 1, &stencil, 1, &everywhere);

    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, caps_);
    for (const std::uint32_t front_bit : {1u, 0u}) {
        set_counting(commands, front_bit == 0);
        for (const DrawnInstance& instance : list.instances) {
            if (!instance.lights[light].casts_shadow) continue;
            push_draw_constants(commands, layout_, list, instance, &instance.lights[light],
                                front_bit);
            // Where all light rays end in one point there is no dark cap.
            const std::uint32_t caps = instance.lights[light].ends_in_one_point ? 1 : 2;
            vkCmdDraw(commands, 3 * instance.face_count, caps, 0, 0);
        }
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sides_);
    set_counting(commands, false);
    for (const DrawnInstance& instance : list.instances) {
        const DrawnLight& drawn = instance.lights[light];
        if (!drawn.casts_shadow) continue;
        push_draw_constants(commands, layout_, list, instance, &drawn, 0);
        vkCmdDrawIndirect(commands, drawn.sides.arguments, 0, 1, sizeof(VkDrawIndirectCommand));
        if (instance.loose_count == 0) continue;
        push_draw_constants(commands, layout_, list, instance, &drawn, 1);
        vkCmdDraw(commands, instance.loose_count, 1, 0, 0);
    }
}

}  // namespace rimline
