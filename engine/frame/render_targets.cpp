#include "engine/frame/render_targets.h"

#include <algorithm>
#include <array>
#include <span>

#include "engine/vulkan/image_barrier.h"
#include "engine/vulkan/layout_uses.h"

namespace rimline {

namespace {

// Size of the viewport over the picture's. Triangles are clipped at the viewport's edges, and the new corners
// are rounded. In orthographic views shadow volumes reach so far that lavapipe rounds these corners by whole
// pixels: the picture's outermost row or column had no shadow. So the viewport is larger than the picture, if
// the device's limits allow it. A power of two changes no rounding of other corners.
constexpr float k_guard = 2.0f;

float fitting_guard(const VkPhysicalDeviceLimits& limits, VkExtent2D extent) {
    const auto fits = [&](std::uint32_t length, std::uint32_t limit) {
        const float size = k_guard * static_cast<float>(length);
        const float excess = 0.5f * (size - static_cast<float>(length));
        return size <= static_cast<float>(limit) && -excess >= limits.viewportBoundsRange[0] &&
               size - excess <= limits.viewportBoundsRange[1];
    };
    const bool fit = fits(extent.width, limits.maxViewportDimensions[0]) &&
                     fits(extent.height, limits.maxViewportDimensions[1]);
    return fit ? k_guard : 1.0f;
}

constexpr StageAccess k_drawing{
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr StageAccess k_sampling{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                 VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

// All uses of the images of a frame. At its begin: those by the frame before.
constexpr StageAccess k_drawing_and_sampling = k_drawing | k_sampling;

// Any access of a caller in stages that it names. Nothing where it names none.
StageAccess in_stages(VkPipelineStageFlags2 stages) {
    if (stages == VK_PIPELINE_STAGE_2_NONE) return {stages, VK_ACCESS_2_NONE};
    return {stages, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
}

// What a caller, or the frame before, did with the target. With an undefined initial layout nothing tells it but the
// layout that frames leave it in. Attachments are always among it: a swapchain's image is waited for in that stage.
StageAccess earlier_uses(const PictureTarget& target) {
    return k_drawing | uses_of(target.initial_layout) | uses_of(target.final_layout) |
           in_stages(target.earlier_stages);
}

StageAccess later_uses(const PictureTarget& target) {
    return uses_of(target.final_layout) | in_stages(target.later_stages);
}

// `area` is the render area; only `drawn`, a part of it, is drawn into.
void begin_rendering(Commands commands, VkExtent2D extent, const VkRect2D& area,
                     const VkRect2D& drawn, float guard,
                     std::span<const VkRenderingAttachmentInfo> colors,
                     const VkRenderingAttachmentInfo* depth = nullptr,
                     const VkRenderingAttachmentInfo* stencil = nullptr, VkOffset2D corner = {}) {
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = area,
                               .layerCount = 1,
                               .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = depth,
                               .pStencilAttachment = stencil};
    commands->CmdBeginRendering(commands, &info);
    const float width = static_cast<float>(extent.width);
    const float height = static_cast<float>(extent.height);
    const VkViewport viewport{.x = static_cast<float>(corner.x) + 0.5f * (1.0f - guard) * width,
                              .y = static_cast<float>(corner.y) + 0.5f * (1.0f - guard) * height,
                              .width = guard * width,
                              .height = guard * height,
                              .minDepth = 0.0f,
                              .maxDepth = 1.0f};
    commands->CmdSetViewport(commands, 0, 1, &viewport);
    commands->CmdSetScissor(commands, 0, 1, &drawn);
}

VkRenderingAttachmentInfo color_attachment(VkImageView view, VkAttachmentLoadOp load) {
    return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = view,
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = {}};
}

// Depth is cleared to infinity, the stencil to zero.
VkRenderingAttachmentInfo depth_attachment(VkImageView view, VkAttachmentLoadOp load) {
    return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = view,
            .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            .loadOp = load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = {.depthStencil = {0.0f, 0}}};
}

}  // namespace

std::uint32_t fitting_scale(const DeviceContext& context, VkExtent2D size, std::uint32_t wanted,
                            std::uint32_t samples, bool has_shadow_colors) {
    // Surfaces (8 bytes) and depth (8, as devices pad it) for each sample and resolved; colors of shadows (8).
    const std::uint64_t pixel_bytes =
        16 * (samples > 1 ? samples + 1 : 1) + (has_shadow_colors ? 8 : 0);
    VkDeviceSize memory = 0;
    for (std::uint32_t i = 0; i < context.memory.memoryHeapCount; ++i)
        if ((context.memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            memory = std::max(memory, context.memory.memoryHeaps[i].size);
    const auto fits = [&](std::uint64_t scale) {
        const std::uint64_t width = scale * size.width;
        const std::uint64_t height = scale * size.height;
        const VkExtent2D limit = max_attachment_extent(context.limits);
        return width <= limit.width && height <= limit.height &&
               width * height * pixel_bytes <= memory / 2;
    };
    std::uint32_t scale = wanted;
    while (scale > 1 && !fits(scale)) --scale;
    return scale;
}

RenderTargets::RenderTargets(const DeviceContext& context, VkExtent2D size,
                             const Sampling& sampling, const Parts& parts)
    : size_(size),
      scale_(sampling.scale),
      samples_(sampling.samples),
      clear_area_(choose_clear_area(context.type, context.driver)),
      keeps_stencil_(parts.keeps_stencil),
      must_resolve_stencil_(!context.independent_resolve_none),
      guard_(fitting_guard(context.limits, pass_extent())) {
    RIMLINE_CHECK(size.width > 0 && size.height > 0 && scale_ > 0);
    RIMLINE_CHECK(!parts.shadow_colors || !is_multisampled());
    const VkExtent2D extent = pass_extent();
    constexpr VkImageUsageFlags k_drawn_and_read =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    surfaces_ = Image(context, {k_surface_format, extent, k_drawn_and_read}, "the picture");
    depth_ = Image(context,
                   {.format = k_depth_stencil_format,
                    .extent = extent,
                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                    .sampled_aspect = VK_IMAGE_ASPECT_DEPTH_BIT},
                   "the picture's depth");
    if (parts.coverage)
        coverage_ = Image(context, {k_surface_format, extent, k_drawn_and_read},
                          "the coverage of the picture's lines");
    if (parts.shadow_colors)
        shadow_colors_ = Image(context, {k_surface_format, extent, k_drawn_and_read},
                               "the picture's colors of shadows");
    if (parts.shapes) {
        shapes_ =
            Image(context, {k_shape_format, extent, k_drawn_and_read}, "the picture's shapes");
        shapes_depth_ = Image(
            context, {k_depth_stencil_format, extent, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
            "the depth of the picture's shapes");
    }
    if (is_multisampled()) {
        // Resolved at the end of the pass, and never read: tiled GPUs need no memory for them.
        constexpr VkImageUsageFlags k_transient = VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        multisampled_surfaces_ = Image(
            context,
            {k_surface_format, extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | k_transient, samples_},
            "the picture's samples");
        multisampled_depth_ =
            Image(context,
                  {k_depth_stencil_format, extent,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | k_transient, samples_},
                  "the depth of the picture's samples");
    }
}

VkRect2D RenderTargets::in_pass(const VkRect2D& rect) const noexcept {
    const auto scale = static_cast<std::int32_t>(scale_);
    return {{rect.offset.x * scale, rect.offset.y * scale},
            {rect.extent.width * scale_, rect.extent.height * scale_}};
}

void RenderTargets::begin_surfaces(Commands commands, const glm::vec3& background,
                                   const DrawnArea& area) const {
    VkRenderingAttachmentInfo color =
        color_attachment((is_multisampled() ? multisampled_surfaces_ : surfaces_).attachment_view(),
                         VK_ATTACHMENT_LOAD_OP_CLEAR);
    color.clearValue.color = {{background.r, background.g, background.b, 0.0f}};
    VkRenderingAttachmentInfo depth =
        depth_attachment((is_multisampled() ? multisampled_depth_ : depth_).attachment_view(),
                         VK_ATTACHMENT_LOAD_OP_CLEAR);
    VkRenderingAttachmentInfo stencil = depth;
    if (!keeps_stencil_ || is_multisampled()) stencil.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (is_multisampled()) {
        color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = surfaces_.attachment_view();
        color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        depth.resolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
        depth.resolveImageView = depth_.attachment_view();
        depth.resolveImageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        if (must_resolve_stencil_) stencil = depth;
    }
    const VkRect2D drawn = in_pass(area.rect);
    begin_rendering(commands, pass_extent(), render_area(drawn), drawn, guard_, {&color, 1}, &depth,
                    &stencil);
}

void RenderTargets::begin_surfaces_beside_shadow(Commands commands, const glm::vec3& background,
                                                 const DrawnArea& area) const {
    std::array colors{
        color_attachment(surfaces_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR),
        color_attachment(shadow_colors_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR)};
    for (VkRenderingAttachmentInfo& color : colors)
        color.clearValue.color = {{background.r, background.g, background.b, 0.0f}};
    const VkRenderingAttachmentInfo depth =
        depth_attachment(depth_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR);
    const VkRect2D drawn = in_pass(area.rect);
    begin_rendering(commands, pass_extent(), render_area(drawn), drawn, guard_, colors, &depth,
                    &depth);
}

void RenderTargets::begin_shadows(Commands commands, const DrawnArea& area) const {
    const VkRenderingAttachmentInfo color =
        color_attachment(surfaces_.attachment_view(), VK_ATTACHMENT_LOAD_OP_LOAD);
    const VkRenderingAttachmentInfo depth =
        depth_attachment(depth_.attachment_view(), VK_ATTACHMENT_LOAD_OP_LOAD);
    VkRenderingAttachmentInfo stencil = depth;
    if (!keeps_stencil_) stencil.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    const VkRect2D drawn = in_pass(area.rect);
    begin_rendering(commands, pass_extent(), drawn, drawn, guard_, {&color, 1}, &depth, &stencil);
}

void RenderTargets::begin_lines(Commands commands, const DrawnArea& area) const {
    const VkRect2D drawn = in_pass(area.rect);
    const VkRenderingAttachmentInfo color =
        color_attachment(surfaces_.attachment_view(), VK_ATTACHMENT_LOAD_OP_LOAD);
    begin_rendering(commands, pass_extent(), drawn, drawn, guard_, {&color, 1});
}

void RenderTargets::begin_picture(Commands commands, const PictureTarget& target,
                                  const DrawnArea& area) {
    const bool is_whole = area.rect.extent.width == target.extent.width &&
                          area.rect.extent.height == target.extent.height;
    const bool is_over = target.use == PictureUse::over;
    VkRenderingAttachmentInfo color =
        color_attachment(target.view, is_over    ? VK_ATTACHMENT_LOAD_OP_LOAD
                                      : is_whole ? VK_ATTACHMENT_LOAD_OP_DONT_CARE
                                                 : VK_ATTACHMENT_LOAD_OP_CLEAR);
    color.clearValue.color = area.around;
    const VkOffset2D corner = target.corner;
    const VkRect2D drawn{{corner.x + area.rect.offset.x, corner.y + area.rect.offset.y},
                         area.rect.extent};
    const VkRect2D area_of_scope = is_over ? drawn : VkRect2D{corner, target.extent};
    begin_rendering(commands, target.extent, area_of_scope, drawn, 1.0f, {&color, 1}, nullptr,
                    nullptr, corner);
}

void RenderTargets::begin_coverage(Commands commands, const DrawnArea& area) const {
    const VkRect2D drawn = in_pass(area.rect);
    const VkRenderingAttachmentInfo color =
        color_attachment(coverage_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR);
    begin_rendering(commands, pass_extent(), render_area(drawn), drawn, guard_, {&color, 1});
}

void RenderTargets::begin_shapes(Commands commands, const DrawnArea& area) const {
    VkRenderingAttachmentInfo depth =
        depth_attachment(shapes_depth_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR);
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;  // Shapes hold the depth that is read.
    const VkRenderingAttachmentInfo color =
        color_attachment(shapes_.attachment_view(), VK_ATTACHMENT_LOAD_OP_CLEAR);
    const VkRect2D drawn = in_pass(area.rect);
    begin_rendering(commands, pass_extent(), render_area(drawn), drawn, guard_, {&color, 1}, &depth,
                    &depth);
}

void RenderTargets::record_before_shapes(Commands commands) const {
    record_barrier(commands, k_drawing_and_sampling, k_drawing,
                   {{shapes_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                    {shapes_depth_, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL}});
}

void RenderTargets::record_after_shapes(Commands commands) const {
    record_barrier(commands, k_drawing, k_sampling,
                   {{shapes_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}});
}

void RenderTargets::record_before_coverage(Commands commands) const {
    record_barrier(
        commands, k_drawing_and_sampling, k_drawing,
        {{coverage_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}});
}

void RenderTargets::record_after_coverage(Commands commands) const {
    constexpr VkImageLayout k_color = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    record_barrier(commands, k_drawing, k_drawing_and_sampling,
                   {{coverage_, k_color, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                    {surfaces_, k_color, k_color}});
}

void RenderTargets::record_before_backdrop(Commands commands, const BackdropDepth& backdrop) {
    // Resolves of depth write as color attachments do.
    const StageAccess written = k_drawing | uses_of(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL) |
                                in_stages(backdrop.earlier_stages);
    // It keeps its layout, which may be of the depth alone: an image barrier would name that of the stencil too.
    record_barrier(commands, written, k_sampling);
}

void RenderTargets::record_before_surfaces(Commands commands) const {
    constexpr VkImageLayout k_fresh = VK_IMAGE_LAYOUT_UNDEFINED;
    constexpr VkImageLayout k_color = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    constexpr VkImageLayout k_depth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    if (is_multisampled())
        record_barrier(commands, k_drawing_and_sampling, k_drawing,
                       {{surfaces_, k_fresh, k_color},
                        {depth_, k_fresh, k_depth},
                        {multisampled_surfaces_, k_fresh, k_color},
                        {multisampled_depth_, k_fresh, k_depth}});
    else if (has_shadow_colors())
        record_barrier(commands, k_drawing_and_sampling, k_drawing,
                       {{surfaces_, k_fresh, k_color},
                        {shadow_colors_, k_fresh, k_color},
                        {depth_, k_fresh, k_depth}});
    else
        record_barrier(commands, k_drawing_and_sampling, k_drawing,
                       {{surfaces_, k_fresh, k_color}, {depth_, k_fresh, k_depth}});
}

void RenderTargets::record_before_shadows(Commands commands) const {
    constexpr VkImageLayout k_color = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    constexpr VkImageLayout k_depth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    record_barrier(commands, k_drawing, k_drawing_and_sampling,
                   {{surfaces_, k_color, k_color},
                    {shadow_colors_, k_color, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                    {depth_, k_depth, k_depth}});
}

void RenderTargets::record_before_lines(Commands commands) const {
    constexpr VkImageLayout k_color = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    record_barrier(commands, k_drawing, k_drawing_and_sampling,
                   {{surfaces_, k_color, k_color},
                    {depth_, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                     VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL}});
}

void RenderTargets::record_before_picture(Commands commands, const PictureTarget& target) const {
    record_barrier(commands, earlier_uses(target), k_drawing_and_sampling,
                   {{surfaces_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                    {target, target.initial_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}});
}

void RenderTargets::record_after_picture(Commands commands, const PictureTarget& target) {
    record_barrier(commands, k_drawing, later_uses(target),
                   {{target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, target.final_layout}});
}

}  // namespace rimline
