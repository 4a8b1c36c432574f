#include "engine/clouds/splat_renderer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "engine/clouds/splat_pass.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/composite_pass.h"
#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"

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

struct SplatRenderer::State {
    // A cloud on the device.
    struct Uploaded {
        const SplatCloud* cloud = nullptr;
        std::uint64_t revision = 0;
        Buffer splats, strokes;
        std::uint32_t splat_count = 0, stroke_count = 0;
    };
    // The objects that a frame uses until it is done.
    struct Frame {
        Buffer strokes;
        // The previous cloud: the previous frame may still use it.
        std::unique_ptr<Uploaded> replaced;
    };

    State(const DeviceContext& device_context, const SplatRendererOptions& asked)
        : context(device_context),
          options{std::min(asked.samples, context.samples), asked.scale},
          splat_pass(context, {.color = k_surface_format,
                               .depth_stencil = k_depth_stencil_format,
                               .samples = options.samples}),
          composite_pass(context) {}

    void prepare_targets(VkExtent2D size);
    void prepare_cloud(const SplatCloud* cloud, Frame& frame);

    DeviceContext context;
    SplatRendererOptions options;
    SplatPass splat_pass;
    CompositePass composite_pass;
    std::unique_ptr<RenderTargets> targets;
    std::unique_ptr<Uploaded> uploaded;
    std::array<Frame, k_frames_in_flight> frames;
    std::uint64_t recorded = 0;
};

SplatRenderer::SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options)
    : state_(std::make_unique<State>(context, options)) {}
SplatRenderer::~SplatRenderer() = default;
SplatRenderer::SplatRenderer(SplatRenderer&&) noexcept = default;
SplatRenderer& SplatRenderer::operator=(SplatRenderer&&) noexcept = default;

void SplatRenderer::set_scale(std::uint32_t scale) noexcept { state_->options.scale = scale; }

void SplatRenderer::State::prepare_targets(VkExtent2D size) {
    const std::uint32_t scale = fitting_scale(context, size, options.scale, options.samples);
    if (targets && targets->size().width == size.width && targets->size().height == size.height &&
        targets->scale() == scale)
        return;
    targets.reset();  // Frees their memory before the new ones are made.
    auto made = std::make_unique<RenderTargets>(context, size, scale, options.samples);
    composite_pass.set_surfaces(made->surfaces());
    targets = std::move(made);
}

void SplatRenderer::State::prepare_cloud(const SplatCloud* cloud, Frame& frame) {
    if (cloud == nullptr) {
        frame.replaced = std::move(uploaded);
        return;
    }
    if (uploaded && uploaded->cloud == cloud && uploaded->revision == cloud->revision) return;
    auto made = std::make_unique<Uploaded>();
    made->splats =
        upload_buffer(context, std::span<const gpu::SplatRecord>(cloud->splats), "the points");
    made->strokes =
        upload_buffer(context, std::span<const gpu::StrokeRecord>(cloud->strokes), "the lines");
    made->splat_count = static_cast<std::uint32_t>(cloud->splats.size());
    made->stroke_count = static_cast<std::uint32_t>(cloud->strokes.size());
    made->cloud = cloud;
    made->revision = cloud->revision;
    frame.replaced = std::move(uploaded);
    uploaded = std::move(made);
}

void SplatRenderer::record(VkCommandBuffer buffer, const SplatScene& scene,
                           const PictureTarget& target) {
    State& state = *state_;
    const Commands commands(*state.context.vk, buffer);
    state.prepare_targets(target.extent);
    const CompositeKind kind{target.format, state.targets->scale()};
    state.composite_pass.prepare(state.context, kind);
    // The GPU is done with the frame that had this slot before.
    State::Frame& frame = state.frames[state.recorded % k_frames_in_flight];
    frame.replaced.reset();
    const std::size_t bytes = scene.strokes.size() * sizeof(gpu::StrokeRecord);
    if (frame.strokes.size() < std::max<std::size_t>(bytes, 4))
        frame.strokes = Buffer(state.context, bytes + bytes / 2, BufferPlace::upload, "the lines");
    // The last step that may fail: the previous frame may still draw what it replaces.
    state.prepare_cloud(scene.cloud, frame);
    if (bytes > 0) std::memcpy(frame.strokes.mapped(), scene.strokes.data(), bytes);
    ++state.recorded;

    state.targets->record_before_surfaces(commands, target);
    const DrawnArea area = DrawnArea::whole(target.extent);
    state.targets->begin_surfaces(commands, scene.background, area);
    gpu::SplatConstants constants = constants_of(scene, *state.targets);
    if (state.uploaded) {
        constants.splats = state.uploaded->splats.address();
        constants.strokes = state.uploaded->strokes.address();
        state.splat_pass.record(commands, constants, state.uploaded->splat_count,
                                state.uploaded->stroke_count);
    }
    constants.strokes = frame.strokes.address();
    state.splat_pass.record(commands, constants, 0,
                            static_cast<std::uint32_t>(scene.strokes.size()));
    commands->CmdEndRendering(commands);
    state.targets->record_before_picture(commands);
    RenderTargets::begin_picture(commands, target, area);
    state.composite_pass.record(commands, kind, glm::vec3(0.0f));
    commands->CmdEndRendering(commands);
    RenderTargets::record_after_picture(commands, target);
}

Picture SplatRenderer::render(const SplatScene& scene, std::uint32_t width, std::uint32_t height) {
    State& state = *state_;
    const VkExtent2D size{width, height};
    const Image image = make_picture_image(state.context, size);
    const Buffer pixels = make_picture_buffer(state.context, size);
    state.uploaded.reset();  // Another cloud may be at the same address now.
    run_commands(state.context, [&](Commands commands) {
        record(commands, scene, picture_target(image));
        record_read_back(commands, image.handle(), size, pixels);
    });
    return read_picture(pixels, size);
}

}  // namespace rimline
