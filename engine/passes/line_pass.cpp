#include "engine/passes/line_pass.h"

#include "engine/passes/line_path_choice.h"
#include "line_adjacency_geom.h"
#include "line_adjacency_vert.h"
#include "line_frag.h"
#include "line_geom.h"
#include "line_vert.h"
#include "picture_line_frag.h"
#include "picture_line_vert.h"
#include "points_vert.h"

namespace rimline {

namespace {

GraphicsPipelineDescription description_of(LinePath path, VkFormat format,
                                           VkPipelineLayout layout) {
    GraphicsPipelineDescription description{.vertex = line_vert,
                                            .geometry = {},
                                            .fragment = line_frag,
                                            .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                            .formats = {.color = format},
                                            .blend = Blend::maximum_alpha,
                                            .layout = layout};
    if (needs_geometry_shader(path)) {
        description.vertex = points_vert;
        description.geometry = line_geom;
        description.topology = VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    }
    return description;
}

}  // namespace

LinePass::LinePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                   VkFormat surface_format, LinePath path)
    : surface_format_(surface_format),
      path_(choose_line_path(path, context.type, context.features.geometry_shader)),
      depth_(context, "depth for lines", 1),
      layout_(make_pipeline_layout(context, "lines", sizeof(gpu::DrawConstants), k_draw_stages,
                                   {draw_data, depth_.layout()})) {}

void LinePass::prepare_edges(const DeviceContext& context) {
    if (has_edges()) return;
    if (path_ == LinePath::adjacency)
        adjacency_ =
            make_graphics_pipeline(context, "lines by adjacency",
                                   {.vertex = line_adjacency_vert,
                                    .geometry = line_adjacency_geom,
                                    .fragment = line_frag,
                                    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY,
                                    .formats = {.color = surface_format_},
                                    .blend = Blend::maximum_alpha,
                                    .layout = layout_});
    edges_ =
        make_graphics_pipeline(context, "lines", description_of(path_, surface_format_, layout_));
}

void LinePass::prepare_segments(const DeviceContext& context) {
    if (has_segments()) return;
    segments_ = make_graphics_pipeline(context, "segments",
                                       {.vertex = picture_line_vert,
                                        .geometry = {},
                                        .fragment = picture_line_frag,
                                        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                        .formats = {.color = surface_format_},
                                        .blend = Blend::maximum_alpha,
                                        .layout = layout_});
}

void LinePass::record_list(Commands commands, std::uint32_t edge_count) const {
    if (edge_count == 0) return;
    if (needs_geometry_shader(path_))
        commands->CmdDraw(commands, edge_count, 1, 0, 0);
    else
        commands->CmdDraw(commands, 4, edge_count, 0, 0);
}

void LinePass::record_every_edge(Commands commands, const DrawList& list,
                                 const DrawnInstance& instance) const {
    const EveryEdgeDraw& every = instance.every_edge;
    if (path_ == LinePath::adjacency) {
        if (every.adjacency_index_count > 0) {
            commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, adjacency_);
            set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_TESTED);
            commands->CmdBindIndexBuffer(commands, every.adjacency, 0, VK_INDEX_TYPE_UINT32);
            commands->CmdDrawIndexed(commands, every.adjacency_index_count, 1, 0, 0, 0);
            commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, edges_);
        }
    } else {
        set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_TESTED);
        record_list(commands, every.regular_edge_count);
    }
    set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_IRREGULAR);
    record_list(commands, every.irregular_pair_count);
}

void LinePass::record_edges(Commands commands, const DrawList& list, const DrawnInstance& instance,
                            std::uint32_t material_ink) const {
    if (draws_slots(path_)) {
        set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_SILHOUETTE,
                 material_ink);
        commands->CmdDrawIndirect(
            commands, instance.silhouette.arguments,
            path_ == LinePath::geometry ? IndirectDraw::k_points : IndirectDraw::k_strips, 1,
            sizeof(VkDrawIndirectCommand));
    } else {
        record_every_edge(commands, list, instance);
    }
    set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_BORDER, material_ink);
    record_list(commands, instance.border_count);
    set_draw(commands, layout_, list, instance, nullptr, RIMLINE_LINES_CREASE, material_ink);
    record_list(commands, instance.crease_count);
}

void LinePass::record(Commands commands, const DrawList& list, std::size_t ink) const {
    const VkDescriptorSet set = depth_.get();
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 1, 1, &set,
                                    0, nullptr);
    const auto record_with = [&](VkPipeline pipeline, bool has_segments, const auto& record_ink) {
        if (pipeline == VK_NULL_HANDLE) return;
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        for (const DrawnInstance& instance : list.instances) {
            if (!instance.has_lines || instance.has_segments != has_segments) continue;
            for (const DrawnInk& drawn : instance.inks)
                if (drawn.ink == ink) record_ink(instance, drawn);
        }
    };
    record_with(edges_, false, [&](const DrawnInstance& instance, const DrawnInk& drawn) {
        record_edges(commands, list, instance, drawn.material_ink);
    });
    record_with(segments_, true, [&](const DrawnInstance& instance, const DrawnInk& drawn) {
        if (drawn.segment_count == 0) return;
        set_draw(commands, layout_, list, instance, nullptr, 0);
        commands->CmdDraw(commands, 4, drawn.segment_count, 0, drawn.first_segment);
    });
}

}  // namespace rimline
