#include "engine/measure/ratio_drawing.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "composite_vert.h"
#include "engine/vulkan/image_barrier.h"
#include "engine/vulkan/rounding.h"
#include "visible_line_vert.h"
#include "visible_surface_vert.h"

namespace rimline {

namespace {

// Depth bias of surfaces, in changes of depth from a pixel to the next. Negative is away from the viewer,
// because depth is reversed. visible_ratio.h says why it is 2.
constexpr float k_surface_bias_slopes = -2.0f;

// A line is drawn as four triangles over six corners (shaders/visible_line.vert).
constexpr std::array<std::uint32_t, 12> k_line_triangles{0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 5};
constexpr std::uint32_t k_line_corners = 6;
// Lines in a draw call: the size of the index buffer, 192 KiB. More lines take several calls.
constexpr std::uint32_t k_lines_a_draw = 4096;

GraphicsPipelineDescription surface_description(VkPipelineLayout layout) {
    return {.vertex = visible_surface_vert,
            .geometry = {},
            .fragment = {},
            .formats = {.depth_stencil = k_depth_stencil_format},
            .depth_compare = VK_COMPARE_OP_GREATER,
            .depth_write = true,
            .depth_bias_slopes = k_surface_bias_slopes,
            .layout = layout};
}

// The stencil test passes where no visible line was drawn before. With `depth_compare` never, all lines are
// hidden.
GraphicsPipelineDescription line_description(VkPipelineLayout layout, VkCompareOp depth_compare) {
    return {.vertex = visible_line_vert,
            .geometry = {},
            .fragment = {},
            .formats = {.depth_stencil = k_depth_stencil_format},
            .depth_compare = depth_compare,
            .stencil = StencilUse::given,
            .stencil_state = {.failOp = VK_STENCIL_OP_KEEP,
                              .passOp = VK_STENCIL_OP_REPLACE,
                              .depthFailOp = VK_STENCIL_OP_DECREMENT_AND_CLAMP,
                              .compareOp = VK_COMPARE_OP_NOT_EQUAL,
                              .compareMask = k_stencil_visible,
                              .writeMask = 0xff,
                              .reference = k_stencil_visible},
            .layout = layout};
}

// The stencil test passes where a line was drawn.
GraphicsPipelineDescription count_description(VkPipelineLayout layout) {
    return {.vertex = composite_vert,
            .geometry = {},
            .fragment = {},
            .formats = {.depth_stencil = k_depth_stencil_format},
            .stencil = StencilUse::given,
            .stencil_state = {.failOp = VK_STENCIL_OP_KEEP,
                              .passOp = VK_STENCIL_OP_KEEP,
                              .depthFailOp = VK_STENCIL_OP_KEEP,
                              .compareOp = VK_COMPARE_OP_NOT_EQUAL,
                              .compareMask = 0xff,
                              .writeMask = 0,
                              .reference = k_stencil_nothing},
            .layout = layout};
}

Buffer upload_line_triangles(const DeviceContext& context) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t line = 0; line < k_lines_a_draw; ++line)
        for (const std::uint32_t corner : k_line_triangles)
            indices.push_back(k_line_corners * line + corner);
    return upload_buffer(context, std::span<const std::uint32_t>(indices), "indices of lines");
}

// Moves all targets to `new_layout`: to be drawn into, with undefined content, or to be copied from.
void record_target_barrier(Commands commands, std::span<const Image> targets,
                           VkImageLayout new_layout) {
    const bool begins = new_layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    constexpr VkPipelineStageFlags2 k_tests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkImageLayout k_drawn = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    constexpr StageAccess k_drawing{k_tests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                                                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    std::vector<ImageTransition> transitions;
    for (const Image& target : targets)
        transitions.emplace_back(target, begins ? VK_IMAGE_LAYOUT_UNDEFINED : k_drawn, new_layout);
    if (begins)
        record_barrier(commands,
                       {k_tests | VK_PIPELINE_STAGE_2_COPY_BIT,
                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
                       k_drawing, transitions);
    else
        record_barrier(commands, {k_tests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT}, transitions);
}

}  // namespace

// Where the data of one view is.
struct RatioDrawing::Places {
    VkImageView image;
    VkDeviceAddress lines;
    VkDeviceSize copied_faces;  // An offset in the upload.
    std::uint32_t first_query;
};

RatioDrawing::RatioDrawing(const DeviceContext& context, const Mesh& mesh,
                           std::span<const Triangle> triangles, const Options& options)
    : context_(context),
      options_(options),
      positions_(upload_buffer(context, mesh.positions(), "positions")),
      triangles_(upload_buffer(context, triangles, "triangles")),
      line_triangles_(upload_line_triangles(context)),
      layout_(make_pipeline_layout(context, "visible ratios", sizeof(gpu::RatioConstants),
                                   VK_SHADER_STAGE_VERTEX_BIT)) {
    GraphicsPipelineDescription surface = surface_description(layout_);
    all_faces_ = make_graphics_pipeline(context, "visible ratios, all faces", surface);
    surface.cull = VK_CULL_MODE_BACK_BIT;
    front_faces_ = make_graphics_pipeline(context, "visible ratios, front faces", surface);
    tested_lines_ =
        make_graphics_pipeline(context, "visible ratios, visible lines",
                               line_description(layout_, VK_COMPARE_OP_GREATER_OR_EQUAL));
    hidden_lines_ = make_graphics_pipeline(context, "visible ratios, hidden lines",
                                           line_description(layout_, VK_COMPARE_OP_NEVER));
    count_ = make_graphics_pipeline(context, "visible ratios, count", count_description(layout_));
}

// Copies to buffers begin at multiples of four bytes.
VkDeviceSize RatioDrawing::stencil_stride() const noexcept {
    return rounded_up<VkDeviceSize>(VkDeviceSize{options_.side_px} * options_.side_px, 4);
}

void RatioDrawing::prepare(RatioTargets& targets, std::span<const RatioView> views,
                           bool keeps_stencil) const {
    const VkExtent2D extent{options_.side_px, options_.side_px};
    const std::size_t needed = options_.has_separate_targets ? views.size() : 1;
    while (targets.images.size() < needed)
        targets.images.emplace_back(
            context_,
            ImageDescription{.format = k_depth_stencil_format,
                             .extent = extent,
                             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
            "the picture of a visible ratio");
    if (!targets.queries && options_.has_queries)
        targets.queries = QueryPool(context_, VK_QUERY_TYPE_OCCLUSION, 2 * options_.max_views,
                                    "counts of pixels");
    const VkDeviceSize stencil_bytes = stencil_stride() * views.size();
    if (keeps_stencil && targets.stencils.size() < stencil_bytes)
        targets.stencils = Buffer(context_, stencil_bytes, BufferPlace::readback,
                                  "the stencils of visible ratios");
    std::uint64_t upload_bytes = 0;
    for (const RatioView& view : views) upload_bytes += view.upload_bytes();
    if (targets.upload.size() < upload_bytes)
        targets.upload =
            Buffer(context_, upload_bytes, BufferPlace::upload, "the lines of visible ratios");
    std::uint64_t offset = 0;
    const auto copy = [&](const auto& values) {
        const std::uint64_t bytes = values.size() * sizeof values[0];
        if (bytes > 0) std::memcpy(targets.upload.mapped() + offset, values.data(), bytes);
        offset += bytes;
    };
    for (const RatioView& view : views) {
        copy(view.lines);
        copy(view.copied_faces);
    }
}

void RatioDrawing::record(Commands commands, const RatioTargets& targets,
                          std::span<const RatioView> views, bool keeps_stencil) const {
    if (options_.has_queries) targets.queries.record_reset(commands);
    const bool is_shared = !options_.has_separate_targets;
    const auto images = std::span(targets.images).first(is_shared ? 1 : views.size());
    constexpr VkImageLayout k_attachment = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    if (!is_shared) record_target_barrier(commands, images, k_attachment);
    const float side = float(options_.side_px);
    const VkViewport viewport{0.0f, 0.0f, side, side, 0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, {options_.side_px, options_.side_px}};
    commands->CmdSetViewport(commands, 0, 1, &viewport);
    commands->CmdSetScissor(commands, 0, 1, &scissor);
    std::uint64_t offset = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (is_shared) record_target_barrier(commands, images, k_attachment);
        const RatioView& view = views[v];
        const Places places{.image = images[is_shared ? 0 : v].attachment_view(),
                            .lines = targets.upload.address() + offset,
                            .copied_faces = offset + view.lines.size() * sizeof view.lines[0],
                            .first_query = static_cast<std::uint32_t>(2 * v)};
        record_view(commands, targets, view, places, keeps_stencil);
        offset += view.upload_bytes();
    }
    if (!keeps_stencil) return;
    record_target_barrier(commands, images, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    record_stencil_copies(commands, targets, views.size());
}

void RatioDrawing::record_stencil_copies(Commands commands, const RatioTargets& targets,
                                         std::size_t view_count) const {
    for (std::size_t v = 0; v < view_count; ++v) {
        const VkBufferImageCopy region{.bufferOffset = v * stencil_stride(),
                                       .imageSubresource = {VK_IMAGE_ASPECT_STENCIL_BIT, 0, 0, 1},
                                       .imageExtent = {options_.side_px, options_.side_px, 1}};
        commands->CmdCopyImageToBuffer(commands, targets.images[v].handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       targets.stencils.handle(), 1, &region);
    }
    record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

void RatioDrawing::record_view(Commands commands, const RatioTargets& targets,
                               const RatioView& view, const Places& places,
                               bool keeps_stencil) const {
    // Depth 0 is infinitely far.
    const VkRenderingAttachmentInfo depth{
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = places.image,
        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .clearValue = {.depthStencil = {0.0f, k_stencil_nothing}}};
    VkRenderingAttachmentInfo stencil = depth;
    if (keeps_stencil) stencil.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {{0, 0}, {options_.side_px, options_.side_px}},
                                    .layerCount = 1,
                                    .pDepthAttachment = &depth,
                                    .pStencilAttachment = &stencil};
    gpu::RatioConstants constants = view.constants;
    constants.positions = positions_.address();
    constants.lines = places.lines;
    commands->CmdBeginRendering(commands, &rendering);
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof constants,
                               &constants);
    record_faces(commands, targets, view, places);

    commands->CmdBindIndexBuffer(commands, line_triangles_.handle(), 0, VK_INDEX_TYPE_UINT32);
    const auto counted = [&](std::uint32_t query, const auto& draw) {
        if (options_.has_queries)
            commands->CmdBeginQuery(commands, targets.queries.handle(), query,
                                    VK_QUERY_CONTROL_PRECISE_BIT);
        draw();
        if (options_.has_queries) commands->CmdEndQuery(commands, targets.queries.handle(), query);
    };
    counted(places.first_query,
            [&] { record_lines(commands, tested_lines_, 0, view.tested_lines); });
    const auto line_count = static_cast<std::uint32_t>(view.lines.size());
    if (view.tested_lines < line_count)
        record_lines(commands, hidden_lines_, view.tested_lines, line_count);
    if (options_.has_queries)
        counted(places.first_query + 1, [&] {
            commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, count_);
            commands->CmdDraw(commands, 3, 1, 0, 0);
        });
    commands->CmdEndRendering(commands);
}

void RatioDrawing::record_faces(Commands commands, const RatioTargets& targets,
                                const RatioView& view, const Places& places) const {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                              view.culls_backs ? front_faces_ : all_faces_);
    if (!view.copied_faces.empty()) {
        commands->CmdBindIndexBuffer(commands, targets.upload.handle(), places.copied_faces,
                                     VK_INDEX_TYPE_UINT32);
        commands->CmdDrawIndexed(commands, 3 * static_cast<std::uint32_t>(view.copied_faces.size()),
                                 1, 0, 0, 0);
        return;
    }
    commands->CmdBindIndexBuffer(commands, triangles_.handle(), 0, VK_INDEX_TYPE_UINT32);
    for (const IndexRun& run : view.faces)
        commands->CmdDrawIndexed(commands, run.count, 1, run.first, 0, 0);
}

void RatioDrawing::record_lines(Commands commands, VkPipeline pipeline, std::uint32_t first,
                                std::uint32_t end) const {
    constexpr auto k_indices_a_line = static_cast<std::uint32_t>(k_line_triangles.size());
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    for (; first < end; first += k_lines_a_draw)
        commands->CmdDrawIndexed(commands, k_indices_a_line * std::min(end - first, k_lines_a_draw),
                                 1, 0, static_cast<std::int32_t>(k_line_corners * first), 0);
}

}  // namespace rimline
