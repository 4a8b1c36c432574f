#include "engine/splat_renderer.h"

#include <algorithm>
#include <span>

#include "engine/barrier.h"

namespace rimline {

namespace {

constexpr VkFormat k_picture_format = VK_FORMAT_R8G8B8A8_UNORM;

gpu::SplatConstants constants_of(const SplatScene& scene, const RenderTargets& targets) {
    const VkExtent2D extent = targets.pass_extent();
    const Projection projection = make_projection(
        scene.camera, double(extent.width) / extent.height, scene.center, scene.radius);
    return {.splats = 0,
            .strokes = 0,
            .eye_from_world = glm::mat3(camera_from_world(scene.camera)),
            .camera = glm::vec3(scene.camera.eye),
            .clip_scale = glm::vec2(projection.scale) / targets.guard(),
            .clip_z = glm::vec2(projection.z),
            .clip_w = glm::vec2(projection.w),
            .half_extent = {0.5f * float(extent.width), 0.5f * float(extent.height)},
            .guard = targets.guard(),
            .scale = float(targets.scale())};
}

}  // namespace

SplatRenderer::SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options)
    : context_(context),
      options_{std::min(options.samples, context.samples), options.scale},
      splat_pass_(context, {.color = k_surface_format,
                            .depth_stencil = k_depth_stencil_format,
                            .samples = options_.samples}),
      composite_pass_(context) {}

Picture SplatRenderer::render(const SplatScene& scene, std::uint32_t width, std::uint32_t height) {
    const VkExtent2D size{width, height};
    const RenderTargets targets(context_, size,
                                fitting_scale(context_, size, options_.scale, options_.samples),
                                options_.samples);
    const CompositeKind kind{k_picture_format, targets.scale(), /*has_grid=*/false};
    composite_pass_.prepare(context_, kind);
    composite_pass_.set_images(targets.surfaces(), targets.lines());
    const Image image(
        context_,
        {.format = k_picture_format,
         .extent = size,
         .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
        "the picture");
    const Buffer pixels(context_, VkDeviceSize{4} * width * height, BufferPlace::readback,
                        "the picture");
    const Buffer splats =
        upload_buffer(context_, std::span<const gpu::SplatRecord>(scene.splats), "the points");
    const Buffer strokes =
        upload_buffer(context_, std::span<const gpu::StrokeRecord>(scene.strokes), "the lines");
    gpu::SplatConstants constants = constants_of(scene, targets);
    constants.splats = splats.address();
    constants.strokes = strokes.address();
    const PictureTarget target{.image = image.handle(),
                               .view = image.attachment_view(),
                               .format = k_picture_format,
                               .extent = size,
                               .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    run_commands(context_, [&](VkCommandBuffer commands) {
        targets.record_before_surfaces(commands, target);
        const glm::vec4 background(scene.background, 1.0f);
        targets.begin_surfaces(commands, &background[0]);
        splat_pass_.record(commands, constants, static_cast<std::uint32_t>(scene.splats.size()),
                           static_cast<std::uint32_t>(scene.strokes.size()));
        vkCmdEndRendering(commands);
        // The composite pass reads lines' coverage too: there is none.
        targets.record_before_lines(commands);
        targets.begin_lines(commands);
        vkCmdEndRendering(commands);
        targets.record_before_picture(commands);
        RenderTargets::begin_picture(commands, target);
        composite_pass_.record(commands, kind, {glm::vec4(0.0f), glm::vec4(0.0f)});
        vkCmdEndRendering(commands);
        RenderTargets::record_after_picture(commands, target);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {width, height, 1}};
        vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               pixels.handle(), 1, &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    Picture picture{width, height, {}};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(pixels.mapped());
    picture.rgba.assign(bytes, bytes + std::size_t{4} * width * height);
    return picture;
}

}  // namespace rimline
