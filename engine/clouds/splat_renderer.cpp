#include "engine/clouds/splat_renderer.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "engine/clouds/splat_pass.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/composite_pass.h"
#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/conditional_commands.h"
#include "engine/vulkan/frame_marks.h"
#include "engine/vulkan/uploads.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_default_scale = 2;

gpu::SplatConstants constants_of(const SplatScene& scene, const RenderTargets& targets) {
    const VkExtent2D extent = targets.pass_extent();
    const Projection projection = make_projection(
        scene.camera, double(extent.width) / extent.height, scene.center, scene.radius);
    return {.splats = 0,
            .strokes = 0,
            .eye_from_world = glm::mat3(camera_from_world(scene.camera)),
            .camera = glm::vec3(scene.camera.eye),
            .clip_scale = glm::vec2(projection.scale) / targets.guard(),
            .clip_shift = glm::vec2(projection.shift) / targets.guard(),
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
    // One that frames up to `last_frame` may still use.
    struct Retired {
        std::uint64_t last_frame;
        std::unique_ptr<Uploaded> uploaded;
    };

    State(const DeviceContext& device_context, const SplatRendererOptions& asked)
        : context(device_context),
          wanted_scale(asked.scale == 0 ? k_default_scale : asked.scale),
          frames_in_flight(asked.frames_in_flight),
          splat_pass(
              context,
              {.color = k_surface_format, .depth_stencil = k_depth_stencil_format, .samples = 1}),
          composite_pass(context),
          strokes(frames_in_flight),
          marks(context, frames_in_flight),
          numbers(frames_in_flight),
          uploads(context) {
        RIMLINE_CHECK(frames_in_flight > 0);
    }

    bool is_done(std::uint32_t slot) const noexcept {
        return numbers[slot] == 0 || marks.has(slot, numbers[slot]);
    }
    void forget_recorded() noexcept { std::ranges::fill(numbers, 0); }
    bool has_targets_for(VkExtent2D size) const;
    bool has(const SplatCloud* cloud) const;
    void prepare_targets(VkExtent2D size);
    void prepare_cloud(const SplatCloud* cloud);

    DeviceContext context;
    std::uint32_t wanted_scale;
    std::uint32_t frames_in_flight;
    SplatPass splat_pass;
    CompositePass composite_pass;
    std::unique_ptr<RenderTargets> targets;
    std::unique_ptr<Uploaded> uploaded;
    std::vector<Retired> retired;
    std::vector<Buffer> strokes;  // Of each frame in flight.
    FrameMarks marks;
    std::vector<std::uint64_t>
        numbers;  // Of the last frame of each slot; 0: there is none to wait for.
    std::uint64_t recorded = 0;
    Uploads uploads;  // Declared after the clouds: its destructor waits for their uploads.
};

SplatRenderer::SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options)
    : state_(std::make_unique<State>(context, options)) {}
SplatRenderer::~SplatRenderer() = default;
SplatRenderer::SplatRenderer(SplatRenderer&&) noexcept = default;
SplatRenderer& SplatRenderer::operator=(SplatRenderer&&) noexcept = default;

void SplatRenderer::set_scale(std::uint32_t scale) noexcept {
    state_->wanted_scale = scale == 0 ? k_default_scale : scale;
}

void SplatRenderer::forget_recorded() noexcept { state_->forget_recorded(); }

bool SplatRenderer::State::has_targets_for(VkExtent2D size) const {
    return targets && targets->size().width == size.width &&
           targets->size().height == size.height &&
           targets->scale() == fitting_scale(context, size, wanted_scale, 1);
}

void SplatRenderer::State::prepare_targets(VkExtent2D size) {
    if (has_targets_for(size)) return;
    for (std::uint32_t slot = 0; slot < frames_in_flight; ++slot)
        if (!is_done(slot))
            throw Error(
                ErrorCode::bad_input,
                "prepare(): a target of another size or scale needs other images, while frames "
                "that were recorded before still use these: wait for them");
    targets.reset();  // Frees their memory before the new ones are made.
    const std::uint32_t scale = fitting_scale(context, size, wanted_scale, 1);
    auto made = std::make_unique<RenderTargets>(
        context, size, Sampling{.samples = 1, .scale = scale}, RenderTargets::Parts{});
    composite_pass.set_surfaces(made->surfaces());
    targets = std::move(made);
}

bool SplatRenderer::State::has(const SplatCloud* cloud) const {
    if (!cloud || !uploaded) return !cloud && !uploaded;
    return uploaded->cloud == cloud && uploaded->revision == cloud->revision;
}

void SplatRenderer::State::prepare_cloud(const SplatCloud* cloud) {
    if (has(cloud)) return;
    std::unique_ptr<Uploaded> made;
    if (cloud) {
        made = std::make_unique<Uploaded>();
        UploadBatch batch(context, uploads);
        made->splats = batch.add(std::span<const gpu::SplatRecord>(cloud->splats), "the points");
        made->strokes = batch.add(std::span<const gpu::StrokeRecord>(cloud->strokes), "the lines");
        made->splat_count = static_cast<std::uint32_t>(cloud->splats.size());
        made->stroke_count = static_cast<std::uint32_t>(cloud->strokes.size());
        made->cloud = cloud;
        made->revision = cloud->revision;
        retired.reserve(retired.size() + 1);  // The last step that may fail but for send().
        batch.send();
    }
    if (uploaded) retired.push_back({recorded, std::move(uploaded)});
    uploaded = std::move(made);
}

UploadPoint SplatRenderer::prepare(const SplatScene& scene, const PictureTarget& target) {
    State& state = *state_;
    if (target.use != PictureUse::whole || target.backdrop)
        throw Error(ErrorCode::bad_input, "a point cloud is drawn on its own background only");
    require_condition(state.context, target.condition);
    state.prepare_targets(target.extent);
    state.composite_pass.prepare(state.context, {target.format, state.targets->scale()});
    state.prepare_cloud(scene.cloud);
    return state.uploads.sent();
}

void SplatRenderer::record(VkCommandBuffer into, VkCommandBuffer picture_into,
                           const SplatScene& scene, const PictureTarget& target) {
    State& state = *state_;
    const Commands commands(*state.context.vk, into);
    const Commands picture(*state.context.vk, picture_into);
    RIMLINE_CHECK(state.has_targets_for(target.extent) && state.has(scene.cloud));
    const CompositeKind kind{target.format, state.targets->scale()};
    RIMLINE_CHECK(state.composite_pass.is_prepared(kind));
    const auto slot = static_cast<std::uint32_t>(state.recorded % state.frames_in_flight);
    RIMLINE_CHECK(state.is_done(slot));
    Buffer& strokes = state.strokes[slot];
    if (state.uploads.is_done())
        std::erase_if(state.retired, [&](const State::Retired& retired) {
            return retired.last_frame + state.frames_in_flight <= state.recorded + 1;
        });
    const std::size_t bytes = scene.strokes.size() * sizeof(gpu::StrokeRecord);
    grow(strokes, state.context, bytes, BufferPlace::upload, "the lines");
    if (bytes > 0) std::memcpy(strokes.mapped(), scene.strokes.data(), bytes);
    state.numbers[slot] = ++state.recorded;

    state.targets->record_before_surfaces(commands);
    const DrawnArea area = DrawnArea::whole(target.extent);
    {
        const ConditionalCommands conditional(commands, target.condition);
        state.targets->begin_surfaces(commands, scene.background, area);
        gpu::SplatConstants constants = constants_of(scene, *state.targets);
        if (state.uploaded) {
            constants.splats = state.uploaded->splats.address();
            constants.strokes = state.uploaded->strokes.address();
            state.splat_pass.record(commands, constants, state.uploaded->splat_count,
                                    state.uploaded->stroke_count);
        }
        constants.strokes = strokes.address();
        state.splat_pass.record(commands, constants, 0,
                                static_cast<std::uint32_t>(scene.strokes.size()));
        commands->CmdEndRendering(commands);
    }
    state.targets->record_before_picture(picture, target);
    {
        const ConditionalCommands conditional(picture, target.condition);
        RenderTargets::begin_picture(picture, target, area);
        state.composite_pass.record(picture, kind, glm::vec3(0.0f), target.corner);
        picture->CmdEndRendering(picture);
    }
    RenderTargets::record_after_picture(picture, target);
    state.marks.record(picture, slot, state.recorded);
}

Picture SplatRenderer::render(const SplatScene& scene, std::uint32_t width, std::uint32_t height) {
    State& state = *state_;
    const VkExtent2D size{width, height};
    const Image image = make_picture_image(state.context, size);
    const Buffer pixels = make_picture_buffer(state.context, size);
    const PictureTarget target = picture_target(image);
    // Another cloud may be at the same address now. Copies to the one before may be in progress, where the render()
    // that began them failed.
    if (state.uploaded) state.uploads.wait();
    state.uploaded.reset();
    const UploadPoint uploaded = prepare(scene, target);
    try {
        run_commands(
            state.context,
            [&](Commands commands) {
                record(commands, scene, target);
                record_read_back(commands, image.handle(), size, pixels);
            },
            uploaded);
    } catch (...) {
        state.forget_recorded();  // Its frame has ended, or never began.
        throw;
    }
    return read_picture(pixels, size);
}

}  // namespace rimline
