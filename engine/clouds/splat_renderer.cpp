#include "engine/clouds/splat_renderer.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "engine/picture_readback.h"

namespace rimline {

namespace {

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

void SplatRenderer::prepare_targets(VkExtent2D size) {
    const std::uint32_t scale = fitting_scale(context_, size, options_.scale, options_.samples);
    if (targets_ && targets_->size().width == size.width &&
        targets_->size().height == size.height && targets_->scale() == scale)
        return;
    targets_.reset();  // Frees their memory before the new ones are made.
    auto targets = std::make_unique<RenderTargets>(context_, size, scale, options_.samples);
    composite_pass_.set_surfaces(targets->surfaces());
    targets_ = std::move(targets);
}

void SplatRenderer::prepare_cloud(const SplatCloud* cloud, Frame& frame) {
    if (cloud == nullptr) {
        frame.replaced = std::move(uploaded_);
        return;
    }
    if (uploaded_ && uploaded_->cloud == cloud && uploaded_->revision == cloud->revision) return;
    auto uploaded = std::make_unique<Uploaded>();
    uploaded->splats =
        upload_buffer(context_, std::span<const gpu::SplatRecord>(cloud->splats), "the points");
    uploaded->strokes =
        upload_buffer(context_, std::span<const gpu::StrokeRecord>(cloud->strokes), "the lines");
    uploaded->splat_count = static_cast<std::uint32_t>(cloud->splats.size());
    uploaded->stroke_count = static_cast<std::uint32_t>(cloud->strokes.size());
    uploaded->cloud = cloud;
    uploaded->revision = cloud->revision;
    frame.replaced = std::move(uploaded_);
    uploaded_ = std::move(uploaded);
}

void SplatRenderer::record(VkCommandBuffer commands, const SplatScene& scene,
                           const PictureTarget& target) {
    prepare_targets(target.extent);
    const CompositeKind kind{target.format, targets_->scale()};
    composite_pass_.prepare(context_, kind);
    // The GPU is done with the frame that had this slot before.
    Frame& frame = frames_[recorded_ % k_frames_in_flight];
    frame.replaced.reset();
    const std::size_t bytes = scene.strokes.size() * sizeof(gpu::StrokeRecord);
    if (frame.strokes.size() < std::max<std::size_t>(bytes, 4))
        frame.strokes = Buffer(context_, bytes + bytes / 2, BufferPlace::upload, "the lines");
    // The last step that may fail: the previous frame may still draw what it replaces.
    prepare_cloud(scene.cloud, frame);
    if (bytes > 0) std::memcpy(frame.strokes.mapped(), scene.strokes.data(), bytes);
    ++recorded_;

    targets_->record_before_surfaces(commands, target);
    const DrawnArea area = DrawnArea::whole(target.extent);
    targets_->begin_surfaces(commands, scene.background, area);
    gpu::SplatConstants constants = constants_of(scene, *targets_);
    if (uploaded_) {
        constants.splats = uploaded_->splats.address();
        constants.strokes = uploaded_->strokes.address();
        splat_pass_.record(commands, constants, uploaded_->splat_count, uploaded_->stroke_count);
    }
    constants.strokes = frame.strokes.address();
    splat_pass_.record(commands, constants, 0, static_cast<std::uint32_t>(scene.strokes.size()));
    vkCmdEndRendering(commands);
    targets_->record_before_picture(commands);
    RenderTargets::begin_picture(commands, target, area);
    composite_pass_.record(commands, kind, glm::vec3(0.0f));
    vkCmdEndRendering(commands);
    RenderTargets::record_after_picture(commands, target);
}

Picture SplatRenderer::render(const SplatScene& scene, std::uint32_t width, std::uint32_t height) {
    const VkExtent2D size{width, height};
    const Image image = make_picture_image(context_, size);
    const Buffer pixels = make_picture_buffer(context_, size);
    uploaded_.reset();  // Another cloud may be at the same address now.
    run_commands(context_, [&](VkCommandBuffer commands) {
        record(commands, scene, picture_target(image));
        record_read_back(commands, image.handle(), size, pixels);
    });
    return read_picture(pixels, size);
}

}  // namespace rimline
