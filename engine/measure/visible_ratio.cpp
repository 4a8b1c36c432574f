#include "engine/measure/visible_ratio.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "composite_vert.h"
#include "engine/camera.h"
#include "engine/vulkan/barrier.h"
#include "silhouette/mesh/edge_convexity.h"
#include "silhouette/mesh/solid.h"
#include "visible_line_vert.h"
#include "visible_surface_vert.h"

namespace rimline {

namespace {

// Of depth, towards what is behind: depth is reversed. See the header.
constexpr float k_surface_bias_slopes = -2.0f;

// Faces that were looked at one by one are copied to be drawn. Where there are more than this to look at
// the clusters are drawn, which takes no room.
constexpr std::size_t k_max_copied_faces = 1'000'000;

// More viewpoints a batch save nothing, and leave the GPU idle while the first is prepared.
constexpr std::size_t k_max_views = 16;

// shaders/visible_line.vert.
constexpr std::array<std::uint32_t, 12> k_line_triangles{0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 5};
constexpr std::uint32_t k_line_corners = 6;
constexpr std::uint32_t k_lines_a_draw = 4096;

// What the stencil of a pixel says. Hidden lines count down from nothing, visible ones replace, and once
// visible it stays: whatever the order of lines, a pixel passes the visible ones' test once.
constexpr std::uint8_t k_nothing = 1;
constexpr std::uint8_t k_hidden = 0;
constexpr std::uint8_t k_visible = 0x80;

const Mesh& drawable(const Mesh& mesh) {
    if (mesh.vertex_count() > k_max_indexed_vertices)
        throw Error(ErrorCode::too_large, "more than 2^24 vertices, too many for visible ratios");
    return mesh;
}

Occluders chosen(Occluders occluders, const DeviceContext& context) {
    if (occluders != Occluders::automatic) return occluders;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(context.physical_device, &properties);
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ? Occluders::faces
                                                                : Occluders::clusters;
}

std::uint32_t size32(const auto& values) noexcept {
    return static_cast<std::uint32_t>(values.size());
}

OwnedQueryPool make_query_pool(const DeviceContext& context, std::uint32_t count) {
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_OCCLUSION,
                                     .queryCount = count};
    VkQueryPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateQueryPool(context.device, &info, nullptr, &pool), "vkCreateQueryPool");
    return {context.device, pool};
}

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

// Passes where a line is the first to be seen. `depth_compare` of never makes all lines hidden.
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
                              .compareMask = k_visible,
                              .writeMask = 0xff,
                              .reference = k_visible},
            .layout = layout};
}

// Passes where there is a line.
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
                              .reference = k_nothing},
            .layout = layout};
}

Buffer upload_line_triangles(const DeviceContext& context) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t line = 0; line < k_lines_a_draw; ++line)
        for (const std::uint32_t corner : k_line_triangles)
            indices.push_back(k_line_corners * line + corner);
    return upload_buffer(context, std::span<const std::uint32_t>(indices), "indices of lines");
}

// Of all targets, whatever they held.
void record_target_barrier(VkCommandBuffer commands, std::span<const Image> targets,
                           VkImageLayout new_layout) {
    const bool begins = new_layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    constexpr VkPipelineStageFlags2 k_tests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    std::vector<VkImageMemoryBarrier2> barriers;
    for (const Image& target : targets)
        barriers.push_back(
            {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
             .srcStageMask = begins ? k_tests | VK_PIPELINE_STAGE_2_COPY_BIT : k_tests,
             .srcAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
             .dstStageMask = begins ? k_tests : VK_PIPELINE_STAGE_2_COPY_BIT,
             .dstAccessMask = begins ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                                           VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
                                     : VK_ACCESS_2_TRANSFER_READ_BIT,
             .oldLayout = begins ? VK_IMAGE_LAYOUT_UNDEFINED
                                 : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
             .newLayout = new_layout,
             .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
             .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
             .image = target.handle(),
             .subresourceRange = {target.aspects(), 0, 1, 0, 1}});
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
        .pImageMemoryBarriers = barriers.data()};
    vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

struct VisibleRatioPass::ThreadRoom {
    BlockScratch scratch;
    std::vector<EdgeId> edges;
    LineReach lines;
    std::vector<glm::vec3> corners;  // On the screen.
};

struct VisibleRatioPass::Room {
    tbb::enumerable_thread_specific<ThreadRoom> threads;
};

VisibleRatioPass::VisibleRatioPass(const DeviceContext& context, const HoughOctree& octree,
                                   const VisibleRatioOptions& options, const std::stop_token& stop)
    : context_(context),
      octree_(octree),
      options_(options),
      clusters_(drawable(octree.mesh())),
      occluders_(chosen(options.method.occluders, context)),
      is_solid_(is_solid(octree.mesh(), {stop, {}})),
      concave_bits_(concave_edge_bits(octree.mesh())),
      positions_(upload_buffer(context, octree.mesh().positions(), "positions")),
      triangles_(upload_buffer(context, clusters_.triangles(), "triangles")),
      line_triangles_(upload_line_triangles(context)),
      layout_(
          make_pipeline_layout(context, sizeof(gpu::RatioConstants), VK_SHADER_STAGE_VERTEX_BIT)),
      timeline_(make_timeline(context)),
      command_pool_(make_command_pool(context, context.queue_family)),
      room_(new Room{tbb::enumerable_thread_specific<ThreadRoom>([&octree] {
          return ThreadRoom{octree.make_scratch(), {}, {}, {}};
      })}) {
    RIMLINE_CHECK(options.side_px > 0 && options.fov_deg > 0.0 && options.fov_deg < 180.0);
    RIMLINE_CHECK(options.method.has_separate_targets || counts_by_query());
    GraphicsPipelineDescription surface = surface_description(layout_);
    all_faces_ = make_graphics_pipeline(context, surface);
    surface.cull = VK_CULL_MODE_BACK_BIT;
    front_faces_ = make_graphics_pipeline(context, surface);
    tested_lines_ =
        make_graphics_pipeline(context, line_description(layout_, VK_COMPARE_OP_GREATER_OR_EQUAL));
    hidden_lines_ = make_graphics_pipeline(context, line_description(layout_, VK_COMPARE_OP_NEVER));
    count_ = make_graphics_pipeline(context, count_description(layout_));

    std::array<VkCommandBuffer, 2> commands{};
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = command_pool_,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = static_cast<std::uint32_t>(commands.size())};
    vk_check(vkAllocateCommandBuffers(context.device, &allocate, commands.data()),
             "vkAllocateCommandBuffers");
    for (std::size_t b = 0; b < commands.size(); ++b) batches_[b].commands = commands[b];
}

VisibleRatioPass::~VisibleRatioPass() = default;

bool VisibleRatioPass::counts_by_query() const noexcept {
    return options_.method.counts_by_query && context_.features.occlusion_query_precise;
}

// Copies begin at multiples of four bytes.
VkDeviceSize VisibleRatioPass::stencil_stride() const noexcept {
    return (VkDeviceSize{options_.side_px} * options_.side_px + 3) / 4 * 4;
}

// By the images, of 8 bytes a pixel, and half as much again for lines.
std::size_t VisibleRatioPass::views_a_batch() const noexcept {
    const std::uint64_t view_bytes = std::uint64_t{12} * options_.side_px * options_.side_px;
    const std::uint64_t fitting = options_.budget_bytes / batches_.size() / view_bytes;
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(fitting, 1, k_max_views));
}

void VisibleRatioPass::prepare(View& view, const glm::dvec3& eye, ThreadRoom& room) const {
    const Mesh& mesh = octree_.mesh();
    const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(eye));
    Camera camera{.eye = glm::dvec3(point.xyz()),
                  .target = mesh.center(),
                  .up = mesh.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0),
                  .fov_y_deg = options_.fov_deg};
    if (camera.eye == camera.target) camera.target = camera.eye - glm::dvec3(0, 0, 1);
    const Projection projection = make_projection(camera, 1.0, mesh.center(), mesh.radius());
    const SquareView square{.eye_from_object = glm::mat3(camera_from_world(camera)),
                            .eye = point.xyz(),
                            .focal = float(projection.scale.x),
                            .near_distance = float(projection.z[1]),
                            .side_px = float(options_.side_px)};
    view.constants = {.positions = positions_.address(),
                      .lines = 0,
                      .eye_from_object = square.eye_from_object,
                      .camera = square.eye,
                      .clip_scale = glm::vec2(projection.scale),
                      .near_distance = square.near_distance,
                      .side_px = square.side_px};

    TraversalCounters counters;
    octree_.extract(point, room.edges, counters, room.scratch);
    const bool is_outside = glm::distance(camera.eye, mesh.center()) > mesh.radius();
    view.culls_backs = is_solid_ && is_outside;
    const auto is_hidden_valley = [&](EdgeId edge) {
        const std::uint32_t word = index(edge) / 32;
        return view.culls_backs && word < concave_bits_.size() &&
               (concave_bits_[word] >> (index(edge) % 32) & 1u) != 0;
    };
    const auto hidden = std::partition(room.edges.begin(), room.edges.end(),
                                       [&](EdgeId edge) { return !is_hidden_valley(edge); });

    view.lines.clear();
    room.lines.begin(square);
    const auto add_line = [&](EdgeId edge) {
        const auto& [from, to] = mesh.edge(edge).vertices;
        view.lines.push_back({index(from), index(to)});
    };
    const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
    if (options_.has_borders)
        for (std::uint32_t e = borders.first; e < borders.last; ++e) add_line(EdgeId{e});
    std::for_each(room.edges.begin(), hidden, add_line);
    view.tested_lines = static_cast<std::uint32_t>(view.lines.size());
    std::for_each(hidden, room.edges.end(), add_line);

    view.copied_faces.clear();
    if (occluders_ == Occluders::all) {
        view.faces = {{0, 3 * size32(clusters_.triangles())}};
        return;
    }
    for (std::uint32_t l = 0; l < view.tested_lines; ++l)
        room.lines.add(mesh.positions()[view.lines[l].from], mesh.positions()[view.lines[l].to]);
    clusters_.select(room.lines, view.culls_backs, view.faces);
    std::size_t face_count = 0;
    for (const IndexRun& run : view.faces) face_count += run.count / 3;
    if (occluders_ == Occluders::clusters || face_count > k_max_copied_faces) return;
    room.corners.resize(mesh.vertex_count());
    std::ranges::transform(mesh.positions(), room.corners.begin(), [&](const glm::vec3& position) {
        return room.lines.on_screen(position);
    });
    clusters_.select_faces(room.lines, view.faces, room.corners, view.copied_faces);
    if (view.copied_faces.empty()) view.faces.clear();
}

void VisibleRatioPass::prepare_targets(Batch& batch, std::size_t view_count, bool keeps_stencil) {
    const VkExtent2D extent{options_.side_px, options_.side_px};
    const std::size_t needed = options_.method.has_separate_targets ? view_count : 1;
    while (batch.targets.size() < needed)
        batch.targets.emplace_back(
            context_,
            ImageDescription{.format = k_depth_stencil_format,
                             .extent = extent,
                             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
            "the picture of a visible ratio");
    if (batch.queries.get() == VK_NULL_HANDLE && counts_by_query())
        batch.queries = make_query_pool(context_, static_cast<std::uint32_t>(2 * k_max_views));
    const VkDeviceSize stencil_bytes = stencil_stride() * view_count;
    if (keeps_stencil && batch.stencils.size() < stencil_bytes)
        batch.stencils = Buffer(context_, stencil_bytes, BufferPlace::readback,
                                "the stencils of visible ratios");
}

std::size_t VisibleRatioPass::submit(Batch& batch, std::span<const glm::dvec3> eyes,
                                     bool keeps_stencil) {
    std::size_t count = std::min(eyes.size(), views_a_batch());
    views_.resize(std::max(views_.size(), count));
    tbb::parallel_for(std::size_t{0}, count,
                      [&](std::size_t v) { prepare(views_[v], eyes[v], room_->threads.local()); });

    // As many as there is room for in the share of the budget that images leave.
    const std::uint64_t max_bytes = options_.budget_bytes / batches_.size() / 3;
    std::uint64_t upload_bytes = views_[0].upload_bytes();
    for (std::size_t v = 1; v < count; ++v) {
        if (upload_bytes + views_[v].upload_bytes() > max_bytes)
            count = v;
        else
            upload_bytes += views_[v].upload_bytes();
    }
    prepare_targets(batch, count, keeps_stencil);
    if (batch.upload.size() < upload_bytes)
        batch.upload =
            Buffer(context_, upload_bytes, BufferPlace::upload, "the lines of visible ratios");
    std::uint64_t offset = 0;
    const auto put = [&](auto& values) {
        const std::uint64_t at = offset;
        const std::uint64_t bytes = values.size() * sizeof values[0];
        if (bytes > 0) std::memcpy(batch.upload.mapped() + at, values.data(), bytes);
        offset += bytes;
        return at;
    };
    for (std::size_t v = 0; v < count; ++v) {
        View& view = views_[v];
        view.constants.lines = batch.upload.address() + put(view.lines);
        view.copied_faces_at = put(view.copied_faces);
        work_.lines += view.lines.size();
        if (view.copied_faces.empty())
            for (const IndexRun& run : view.faces) work_.faces += run.count / 3;
        work_.faces += view.copied_faces.size();
    }

    record(batch, count, keeps_stencil);
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = batch.commands};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = timeline_,
                                       .value = submitted_ + 1,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &commands,
                             .signalSemaphoreInfoCount = 1,
                             .pSignalSemaphoreInfos = &signal};
    vk_check(vkQueueSubmit2(context_.queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
    batch.end = ++submitted_;
    batch.view_count = count;
    return count;
}

void VisibleRatioPass::record(const Batch& batch, std::size_t view_count,
                              bool keeps_stencil) const {
    const VkCommandBuffer commands = batch.commands;
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
    vk_check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    if (counts_by_query())
        vkCmdResetQueryPool(commands, batch.queries, 0,
                            static_cast<std::uint32_t>(2 * k_max_views));
    const bool is_shared = !options_.method.has_separate_targets;
    const std::span<const Image> targets(batch.targets.data(), is_shared ? 1 : view_count);
    if (!is_shared)
        record_target_barrier(commands, targets, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    const float side = float(options_.side_px);
    const VkViewport viewport{0.0f, 0.0f, side, side, 0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, {options_.side_px, options_.side_px}};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    for (std::size_t v = 0; v < view_count; ++v) {
        if (is_shared)
            record_target_barrier(commands, targets,
                                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        record_view(batch, v, keeps_stencil);
    }
    if (keeps_stencil) {
        record_target_barrier(commands, targets, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        for (std::size_t v = 0; v < view_count; ++v) {
            const VkBufferImageCopy region{
                .bufferOffset = v * stencil_stride(),
                .imageSubresource = {VK_IMAGE_ASPECT_STENCIL_BIT, 0, 0, 1},
                .imageExtent = {options_.side_px, options_.side_px, 1}};
            vkCmdCopyImageToBuffer(commands, batch.targets[v].handle(),
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, batch.stencils.handle(), 1,
                                   &region);
        }
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    }
    vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
}

void VisibleRatioPass::record_view(const Batch& batch, std::size_t v, bool keeps_stencil) const {
    const VkCommandBuffer commands = batch.commands;
    const View& view = views_[v];
    const Image& target = batch.targets[options_.method.has_separate_targets ? v : 0];
    // Depth 0 is infinitely far.
    const VkRenderingAttachmentInfo depth{
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = target.attachment_view(),
        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .clearValue = {.depthStencil = {0.0f, k_nothing}}};
    VkRenderingAttachmentInfo stencil = depth;
    if (keeps_stencil) stencil.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {{0, 0}, {options_.side_px, options_.side_px}},
                                    .layerCount = 1,
                                    .pDepthAttachment = &depth,
                                    .pStencilAttachment = &stencil};
    vkCmdBeginRendering(commands, &rendering);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof view.constants,
                       &view.constants);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      view.culls_backs ? front_faces_ : all_faces_);
    if (view.copied_faces.empty()) {
        vkCmdBindIndexBuffer(commands, triangles_.handle(), 0, VK_INDEX_TYPE_UINT32);
        for (const IndexRun& run : view.faces)
            vkCmdDrawIndexed(commands, run.count, 1, run.first, 0, 0);
    } else {
        vkCmdBindIndexBuffer(commands, batch.upload.handle(), view.copied_faces_at,
                             VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(commands, 3 * size32(view.copied_faces), 1, 0, 0, 0);
    }

    vkCmdBindIndexBuffer(commands, line_triangles_.handle(), 0, VK_INDEX_TYPE_UINT32);
    const auto draw_lines = [&](VkPipeline pipeline, std::uint32_t first, std::uint32_t end) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        for (; first < end; first += k_lines_a_draw)
            vkCmdDrawIndexed(commands,
                             size32(k_line_triangles) * std::min(end - first, k_lines_a_draw), 1, 0,
                             static_cast<std::int32_t>(k_line_corners * first), 0);
    };
    const auto counted = [&](std::uint32_t query, const auto& draw) {
        if (counts_by_query())
            vkCmdBeginQuery(commands, batch.queries, query, VK_QUERY_CONTROL_PRECISE_BIT);
        draw();
        if (counts_by_query()) vkCmdEndQuery(commands, batch.queries, query);
    };
    const auto query = static_cast<std::uint32_t>(2 * v);
    counted(query, [&] { draw_lines(tested_lines_, 0, view.tested_lines); });
    if (view.tested_lines < view.lines.size())
        draw_lines(hidden_lines_, view.tested_lines, size32(view.lines));
    if (counts_by_query())
        counted(query + 1, [&] {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, count_);
            vkCmdDraw(commands, 3, 1, 0, 0);
        });
    vkCmdEndRendering(commands);
}

void VisibleRatioPass::wait_for(const Batch& batch) const {
    wait_for_timeline(context_, timeline_, batch.end);
}

void VisibleRatioPass::finish(Batch& batch, std::span<VisibleRatio> ratios) const {
    wait_for(batch);
    ratios = ratios.subspan(batch.first_view, batch.view_count);
    if (counts_by_query()) {
        std::array<std::uint32_t, 2 * k_max_views> counts{};
        vk_check(
            vkGetQueryPoolResults(context_.device, batch.queries, 0,
                                  static_cast<std::uint32_t>(2 * batch.view_count), sizeof counts,
                                  counts.data(), sizeof counts[0], VK_QUERY_RESULT_WAIT_BIT),
            "vkGetQueryPoolResults");
        for (std::size_t v = 0; v < ratios.size(); ++v)
            ratios[v] = {.visible_pixels = counts[2 * v], .total_pixels = counts[2 * v + 1]};
    } else {
        const std::size_t pixels = std::size_t{options_.side_px} * options_.side_px;
        const auto* stencil = reinterpret_cast<const std::uint8_t*>(batch.stencils.mapped());
        for (VisibleRatio& ratio : ratios) {
            ratio = {};
            for (const std::uint8_t value : std::span(stencil, pixels)) {
                ratio.total_pixels += value != k_nothing;
                ratio.visible_pixels += value == k_visible;
            }
            stencil += stencil_stride();
        }
    }
    batch.view_count = 0;
}

std::vector<VisibleRatio> VisibleRatioPass::measure(std::span<const glm::dvec3> eyes,
                                                    const LongCall& call) {
    work_ = {};
    std::vector<VisibleRatio> ratios(eyes.size());
    if (octree_.mesh().edge_count() == 0) return ratios;

    // Whatever ends this call, nothing of it is in work when it returns.
    struct Finisher {
        VisibleRatioPass& pass;
        ~Finisher() {
            for (Batch& batch : pass.batches_) {
                if (batch.end > 0) try {
                        pass.wait_for(batch);
                    } catch (const Error&) {
                        // A lost device runs nothing any more.
                    }
                batch.view_count = 0;
            }
        }
    } const finisher{*this};
    std::size_t begun = 0;
    for (std::size_t b = 0; begun < eyes.size(); b = 1 - b) {
        call.checkpoint(double(begun) / double(eyes.size()));
        Batch& batch = batches_[b];
        if (batch.view_count > 0) finish(batch, ratios);
        batch.first_view = begun;
        begun += submit(batch, eyes.subspan(begun), !counts_by_query());
    }
    for (Batch& batch : batches_)
        if (batch.view_count > 0) finish(batch, ratios);
    call.checkpoint(1.0);
    return ratios;
}

std::vector<LinePixel> VisibleRatioPass::mask(const glm::dvec3& eye) {
    const std::size_t pixels = std::size_t{options_.side_px} * options_.side_px;
    std::vector<LinePixel> mask(pixels, LinePixel::none);
    if (octree_.mesh().edge_count() == 0) return mask;
    Batch& batch = batches_[0];
    submit(batch, {&eye, 1}, true);
    batch.view_count = 0;
    wait_for(batch);
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto value = static_cast<std::uint8_t>(batch.stencils.mapped()[i]);
        if (value != k_nothing)
            mask[i] = value == k_visible ? LinePixel::visible : LinePixel::hidden;
    }
    return mask;
}

}  // namespace rimline
