#include "engine/passes/shadow_volume_pass.h"

#include <algorithm>

#include "composite_vert.h"
#include "points_vert.h"
#include "shaders/shadow_emission.h"
#include "shadow_caps_vert.h"
#include "shadow_sides_geom.h"
#include "shadow_sides_vert.h"

namespace rimline {

namespace {

// A ray from the surface away from the viewer crosses as many back faces of a volume as front faces, and one
// back face more if it starts inside. A ray from outside of all volumes to a surface inside one crosses one
// front face more.
void set_counting(Commands commands, ShadowMethod method, bool turned_round) {
    const bool passes = method == ShadowMethod::pass;
    const bool front_counts = passes != turned_round;
    const VkStencilOp up = VK_STENCIL_OP_INCREMENT_AND_WRAP;
    const VkStencilOp down = VK_STENCIL_OP_DECREMENT_AND_WRAP;
    const auto set = [&](VkStencilFaceFlags face, VkStencilOp operation) {
        commands->CmdSetStencilOp(commands, face, VK_STENCIL_OP_KEEP,
                                  passes ? operation : VK_STENCIL_OP_KEEP,
                                  passes ? VK_STENCIL_OP_KEEP : operation, VK_COMPARE_OP_ALWAYS);
    };
    set(VK_STENCIL_FACE_FRONT_BIT, front_counts ? up : down);
    set(VK_STENCIL_FACE_BACK_BIT, front_counts ? down : up);
}

bool is_empty(const VkRect2D& rect) { return rect.extent.width == 0 || rect.extent.height == 0; }

VkRect2D rect_between(std::int64_t left, std::int64_t top, std::int64_t right,
                      std::int64_t bottom) {
    if (right <= left || bottom <= top) return {};
    return {{static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
            {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

std::int64_t right_of(const VkRect2D& rect) {
    return std::int64_t{rect.offset.x} + rect.extent.width;
}
std::int64_t bottom_of(const VkRect2D& rect) {
    return std::int64_t{rect.offset.y} + rect.extent.height;
}

VkRect2D intersection(const VkRect2D& a, const VkRect2D& b) {
    return rect_between(std::max(a.offset.x, b.offset.x), std::max(a.offset.y, b.offset.y),
                        std::min(right_of(a), right_of(b)), std::min(bottom_of(a), bottom_of(b)));
}

// The rectangle around both; an empty one does not count.
VkRect2D joined(const VkRect2D& a, const VkRect2D& b) {
    if (is_empty(a)) return b;
    if (is_empty(b)) return a;
    return rect_between(std::min(a.offset.x, b.offset.x), std::min(a.offset.y, b.offset.y),
                        std::max(right_of(a), right_of(b)), std::max(bottom_of(a), bottom_of(b)));
}

// Binds a pipeline unless it is bound.
class Binding {
public:
    explicit Binding(Commands commands) : commands_(commands) {}
    void bind(VkPipeline pipeline) {
        if (pipeline == bound_) return;
        commands_->CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        bound_ = pipeline;
    }

private:
    Commands commands_;
    VkPipeline bound_ = VK_NULL_HANDLE;
};

// Everything that was counted becomes 1.
constexpr VkStencilOpState k_fold{.failOp = VK_STENCIL_OP_KEEP,
                                  .passOp = VK_STENCIL_OP_REPLACE,
                                  .depthFailOp = VK_STENCIL_OP_KEEP,
                                  .compareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
                                  .compareMask = 0xff,
                                  .writeMask = 0xff,
                                  .reference = 1};

// Everything is counted once.
constexpr VkStencilOpState k_raise{.failOp = VK_STENCIL_OP_KEEP,
                                   .passOp = VK_STENCIL_OP_INCREMENT_AND_WRAP,
                                   .depthFailOp = VK_STENCIL_OP_KEEP,
                                   .compareOp = VK_COMPARE_OP_ALWAYS,
                                   .compareMask = 0xff,
                                   .writeMask = 0xff,
                                   .reference = 0};

}  // namespace

ShadowVolumePass::Pipelines ShadowVolumePass::make_pipelines(const DeviceContext& context,
                                                             const AttachmentFormats& formats,
                                                             VkPipelineLayout layout,
                                                             SideStage stage, bool depth_clamp) {
    Pipelines pipelines;
    GraphicsPipelineDescription description{.vertex = shadow_caps_vert,
                                            .geometry = {},
                                            .fragment = {},
                                            .formats = formats,
                                            .blend = Blend::none_written,
                                            .depth_compare = VK_COMPARE_OP_GREATER,
                                            .depth_clamp = depth_clamp,
                                            .depth_bounds = context.features.depth_bounds,
                                            .stencil = StencilUse::count,
                                            .layout = layout};
    pipelines.caps = make_graphics_pipeline(context, "caps of shadow volumes", description);
    description.vertex = shadow_sides_vert;
    pipelines.pulled_sides =
        make_graphics_pipeline(context, "sides of shadow volumes", description);
    if (stage == SideStage::geometry && context.features.geometry_shader) {
        description.vertex = points_vert;
        description.geometry = shadow_sides_geom;
        description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
        pipelines.geometry_sides = make_graphics_pipeline(
            context, "sides of shadow volumes by geometry shader", description);
    }
    return pipelines;
}

ShadowVolumePass::ShadowVolumePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                                   const AttachmentFormats& formats, SideStage stage)
    : has_depth_bounds_(context.features.depth_bounds),
      layout_(make_pipeline_layout(context, "shadow volumes", sizeof(gpu::DrawConstants),
                                   k_draw_stages, {draw_data})),
      clipping_(make_pipelines(context, formats, layout_, stage, false)),
      clamping_(make_pipelines(context, formats, layout_, stage, true)) {
    fold_ = make_graphics_pipeline(context, "fold of shadow counts",
                                   {.vertex = composite_vert,
                                    .geometry = {},
                                    .fragment = {},
                                    .formats = formats,
                                    .blend = Blend::none_written,
                                    .stencil = StencilUse::given,
                                    .stencil_state = k_fold,
                                    .layout = layout_});
    raise_ = make_graphics_pipeline(context, "counts before the near plane",
                                    {.vertex = composite_vert,
                                     .geometry = {},
                                     .fragment = {},
                                     .formats = formats,
                                     .blend = Blend::none_written,
                                     .depth_bounds = context.features.depth_bounds,
                                     .stencil = StencilUse::given,
                                     .stencil_state = k_raise,
                                     .layout = layout_});
}

void ShadowVolumePass::record(Commands commands, const DrawList& list, std::size_t light,
                              const VkRect2D& area) const {
    // Where the light before has counted.
    if (const VkRect2D counted = light > 0 ? counted_rect(list, light - 1, area) : VkRect2D{};
        !is_empty(counted)) {
        const VkClearAttachment stencil{.aspectMask = VK_IMAGE_ASPECT_STENCIL_BIT,
                                        .clearValue = {.depthStencil = {0.0f, 0}}};
        const VkClearRect rect{.rect = counted, .layerCount = 1};
        commands->CmdClearAttachments(commands, 1, &stencil, 1, &rect);
    }
    for (const ShadowBatch& batch : list.shadow_batches[light]) {
        if (&batch != &list.shadow_batches[light].front()) {
            const VkRect2D counted = counted_rect(list, light, area);
            if (is_empty(counted)) break;
            commands->CmdSetScissor(commands, 0, 1, &counted);
            commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, fold_);
            commands->CmdDraw(commands, 3, 1, 0, 0);
        }
        // One batch after the other, because each fold changes the dynamic state.
        record_near_counts(commands, list, light, batch, area);
        record_caps(commands, list, light, batch, area);
        record_sides(commands, list, light, batch, area);
    }
    commands->CmdSetScissor(commands, 0, 1, &area);
}

VkRect2D ShadowVolumePass::counted_rect(const DrawList& list, std::size_t light,
                                        const VkRect2D& area) {
    VkRect2D all{};
    for (const DrawnInstance& instance : list.instances)
        if (instance.lights[light].casts_shadow)
            all = joined(all, intersection(instance.lights[light].rect, area));
    return all;
}

bool ShadowVolumePass::limit(Commands commands, const DrawnLight& drawn,
                             const VkRect2D& area) const {
    const VkRect2D rect = intersection(drawn.rect, area);
    if (is_empty(rect)) return false;
    commands->CmdSetScissor(commands, 0, 1, &rect);
    if (has_depth_bounds_) commands->CmdSetDepthBounds(commands, drawn.min_depth, drawn.max_depth);
    return true;
}

void ShadowVolumePass::record_near_counts(Commands commands, const DrawList& list,
                                          std::size_t light, const ShadowBatch& batch,
                                          const VkRect2D& area) const {
    for (const ShadowDraw& draw : batch.draws) {
        if (draw.near_count == 0) continue;
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, raise_);
        const DrawnInstance& instance = list.instances[draw.instance];
        if (!limit(commands, instance.lights[light], area)) continue;
        // The pipeline reads nothing, but checks on the GPU crash where its layout's set is not bound (layer 1.4.309).
        set_draw(commands, layout_, list, instance, &instance.lights[light], 0);
        commands->CmdDraw(commands, 3, draw.near_count, 0, 0);
    }
}

void ShadowVolumePass::record_caps(Commands commands, const DrawList& list, std::size_t light,
                                   const ShadowBatch& batch, const VkRect2D& area) const {
    Binding binding(commands);
    for (const std::uint32_t front_bit : {1u, 0u}) {
        for (const ShadowDraw& draw : batch.draws) {
            const DrawnInstance& instance = list.instances[draw.instance];
            const DrawnLight& drawn = instance.lights[light];
            if (drawn.method == ShadowMethod::pass || !draw.has_volume) continue;
            const bool single = drawn.form == ShadowForm::single;
            if (single && front_bit == 0) continue;
            if (!limit(commands, drawn, area)) continue;
            // A light cap is clipped as its surface is: else the near plane would give the two different depths.
            binding.bind(clipping_.caps);
            set_counting(commands, ShadowMethod::fail, front_bit == 0);
            const std::uint32_t flag = draw.part ? RIMLINE_CAPS_PART : 0;
            set_draw(commands, layout_, list, instance, &drawn, front_bit | flag);
            const std::uint32_t first = draw.part ? draw.part->first_face : 0;
            const std::uint32_t count = draw.part ? draw.part->face_count : instance.face_count;
            commands->CmdDraw(commands, 3 * count, 1, 3 * first, 0);
            // If all light rays end in one point, there is no dark cap.
            if (drawn.ends_in_one_point) continue;
            binding.bind(pipelines_of(drawn).caps);
            commands->CmdDraw(commands, 3 * count, 1, 3 * first, 1);
        }
    }
}

void ShadowVolumePass::record_sides(Commands commands, const DrawList& list, std::size_t light,
                                    const ShadowBatch& batch, const VkRect2D& area) const {
    Binding binding(commands);
    for (const ShadowDraw& draw : batch.draws) {
        const DrawnInstance& instance = list.instances[draw.instance];
        const DrawnLight& drawn = instance.lights[light];
        if (!draw.has_volume || !limit(commands, drawn, area)) continue;
        const Pipelines& pipelines = pipelines_of(drawn);
        const bool pulled = pipelines.geometry_sides == VK_NULL_HANDLE;
        const std::uint32_t corners = drawn.ends_in_one_point ? 3 : 6;
        const bool single = drawn.form == ShadowForm::single;
        const std::uint32_t flag = single ? RIMLINE_SIDES_SINGLE : 0;
        if (draw.part) {
            // Geometry shaders number points from 0, wherever a draw begins.
            binding.bind(pipelines.pulled_sides);
            set_counting(commands, drawn.method, false);
            set_draw(commands, layout_, list, instance, &drawn, RIMLINE_SIDES_PARTS | flag);
            commands->CmdDraw(commands, corners * draw.part->side_count, 1,
                              corners * draw.part->first_side, 0);
            continue;
        }
        binding.bind(pulled ? pipelines.pulled_sides : pipelines.geometry_sides);
        set_counting(commands, drawn.method, false);
        set_draw(commands, layout_, list, instance, &drawn, RIMLINE_SIDES_SLOTS | flag);
        const VkDeviceSize offset = !pulled        ? IndirectDraw::k_points
                                    : corners == 3 ? IndirectDraw::k_pointed_sides
                                                   : IndirectDraw::k_sides;
        // In the general form, if the bits of two faces differ, both cast the edge, in the same direction.
        for (int times = single ? 1 : 2; times > 0; --times)
            commands->CmdDrawIndirect(commands, drawn.sides.arguments, offset, 1,
                                      sizeof(VkDrawIndirectCommand));
        if (instance.loose_count == 0) continue;
        set_draw(commands, layout_, list, instance, &drawn, RIMLINE_SIDES_LOOSE | flag);
        commands->CmdDraw(commands, instance.loose_count * (pulled ? corners : 1), 1, 0, 0);
    }
}

}  // namespace rimline
