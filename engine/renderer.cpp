#include "engine/renderer.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "engine/frame/scene_data.h"
#include "engine/picture_readback.h"
#include "engine/vulkan/barrier.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

AttachmentFormats surface_formats(std::uint32_t samples) {
    return {k_surface_format, k_depth_stencil_format, samples};
}

// Where `color` is among `inks`, which it joins if it is new.
std::size_t number_of(std::vector<glm::vec3>& inks, const glm::vec3& color) {
    const auto found = std::ranges::find(inks, color);
    const auto number = static_cast<std::size_t>(found - inks.begin());
    if (found == inks.end()) inks.push_back(color);
    return number;
}

RendererOptions fitted(const DeviceContext& context, RendererOptions options) {
    options.samples = std::min(options.samples, context.samples);
    return options;
}

}  // namespace

Renderer::Renderer(const DeviceContext& context, const RendererOptions& options)
    : context_(context),
      options_(fitted(context, options)),
      own_service_(options.service ? nullptr : std::make_unique<SilhouetteService>()),
      scatter_(context),
      draw_data_(context, k_frames_in_flight),
      surface_pass_(context, draw_data_.layout(), surface_formats(options_.samples)),
      shadow_pass_(context, draw_data_.layout(), surface_formats(options_.samples),
                   options_.shadow_sides),
      line_pass_(context, draw_data_.layout(), k_surface_format, options_.line_path),
      ink_pass_(context, k_surface_format),
      composite_pass_(context),
      timeline_(make_timeline(context)),
      command_pool_(make_command_pool(context, context.queue_family)),
      marks_(context, k_frames_in_flight),
      check_(context, k_frames_in_flight),
      instances_(context, options.service ? *options.service : *own_service_,
                 {.crease_angle_rad = options.crease_angle_rad,
                  .line_path = line_pass_.path(),
                  .ring_slots = k_frames_in_flight,
                  .stream_memory_bytes = options.stream_memory_bytes,
                  .tracker_memory_bytes = options.tracker_memory_bytes}) {
    for (Frame& frame : frames_) {
        const VkCommandBufferAllocateInfo info{
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = command_pool_,
            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
            .commandBufferCount = 1};
        vk_check(vkAllocateCommandBuffers(context.device, &info, &frame.commands),
                 "vkAllocateCommandBuffers");
    }
}

Renderer::~Renderer() {
    try {
        wait_for(submitted_);
    } catch (const Error&) {
        // A lost device is done with everything.
    }
}

void Renderer::wait_for(std::uint64_t timeline_value) const {
    wait_for_timeline(context_, timeline_, timeline_value);
}

bool Renderer::is_done(const Frame& frame) const noexcept {
    const auto slot = static_cast<std::uint32_t>(&frame - frames_.data());
    return frame.number == 0 || marks_.has(slot, frame.number);
}

void Renderer::prepare_targets(VkExtent2D size) {
    const std::uint32_t scale = fitting_scale(context_, size, options_.scale, options_.samples);
    if (targets_ && targets_->size().width == size.width &&
        targets_->size().height == size.height && targets_->scale() == scale)
        return;
    wait_for(submitted_);
    for (const Frame& frame : frames_) RIMLINE_CHECK(frame.timeline_value != 0 || is_done(frame));
    targets_.reset();  // Free before making anew.
    auto targets = std::make_unique<RenderTargets>(context_, size, scale, options_.samples);
    line_pass_.set_surface_depth(targets->depth());
    composite_pass_.set_surfaces(targets->surfaces());
    targets_ = std::move(targets);
}

void Renderer::prepare_picture(VkExtent2D size) {
    const VkExtent2D old = picture_.description().extent;
    if (old.width == size.width && old.height == size.height) return;
    wait_for(submitted_);
    picture_ = {};  // Free before making anew.
    picture_ = make_picture_image(context_, size);
}

const ChangeStream& Renderer::follow(TrackedSilhouette& silhouette, const HomogeneousPoint& point,
                                     Frame& frame) {
    silhouette.follow(point, ring_slot());
    const ChangeStream& stream = silhouette.stream();
    frame.silhouettes.push_back(&silhouette);
    frame.report.bytes_streamed += stream.bytes_streamed();
    frame.report.bytes_full += stream.bytes_full();
    return stream;
}

DrawList Renderer::build_draw_list(const Scene& scene, Frame& frame) {
    const std::size_t light_count = scene.lights.size();
    draw_data_.begin_frame(ring_slot(), frame_data(scene, *targets_), scene.instances.size(),
                           scene.instances.size() * light_count);
    DrawList list{.data = draw_data_.set(ring_slot()),
                  .light_count = light_count,
                  .shadows = scene.shadows,
                  .is_orthographic = scene.camera.is_orthographic(),
                  .style = static_cast<std::uint32_t>(scene.style),
                  .instances = {},
                  .inks = {},
                  .shadow_batches = {}};
    const SceneBounds bounds = bounds_of(scene);
    const VkExtent2D extent = targets_->pass_extent();
    const Projection projection = make_projection(
        scene.camera, double(extent.width) / extent.height, bounds.center, bounds.radius);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const SceneInstance& instance = scene.instances[i];
        InstanceState& state = instances_.all()[i];
        DrawnInstance drawn{.data = 0,
                            .indices = state.mesh->indices(),
                            .vertex_count = state.mesh->vertex_count(),
                            .face_count = state.mesh->face_count(),
                            .border_count = state.mesh->border_count(),
                            .crease_count = 0,
                            .loose_count = state.mesh->loose_count(),
                            .has_lines = has_lines(scene, instance),
                            .fades = instance.fade_radius > 0.0,
                            .ink = 0,
                            .silhouette = {},
                            .every_edge = {},
                            .lights = {}};
        VkDeviceAddress slots = 0;
        if (state.deforming)
            state.deforming->begin_frame(instance.deformation, ring_slot(), frame.deformed);
        if (drawn.has_lines) {
            drawn.ink = number_of(list.inks, line_color(scene, instance));
            drawn.crease_count = crease_count(scene, *state.mesh);
            frame.report.silhouette += drawn.border_count;
            frame.report.creases += drawn.crease_count;
            if (state.mesh->comparator()) drawn.every_edge = state.mesh->comparator()->draw();
        }
        if (drawn.has_lines && state.deforming) {
            RIMLINE_CHECK(draws_slots(line_pass_.path()));
            const GpuSilhouette& found = state.deforming->camera(
                camera_point(instance, lines_camera(scene)), frame.deformed);
            slots = found.slots().address();
            drawn.silhouette = {found.arguments().handle()};
            frame.report.bytes_full += 4 * face_word_count(drawn.face_count);
        } else if (drawn.has_lines && draws_slots(line_pass_.path())) {
            const ChangeStream& stream =
                follow(*state.camera, camera_point(instance, lines_camera(scene)), frame);
            frame.report.camera += state.camera->changes();
            slots = stream.slots().address();
            drawn.silhouette = {stream.arguments().handle()};
            frame.report.silhouette += stream.silhouette_size();
        }
        gpu::InstanceData data = instance_data(scene, instance, *state.mesh, slots);
        if (state.deforming) {
            data.positions = state.deforming->mesh().positions();
            data.corner_normals = state.deforming->mesh().corner_normals();
        }
        drawn.data = draw_data_.put(data);
        const ShadowView view = shadow_view(scene, instance, projection);
        const CasterBox box = caster_box(instance);
        // Of a ground, from below nothing would be seen but its back.
        drawn.shows_backs = !drawn.fades && (!instance.is_solid || state.deforming ||
                                             !is_outside(view, box.low, box.high));
        for (std::size_t l = 0; l < light_count; ++l) {
            const bool casts = casts_shadows(scene, instance);
            const HomogeneousPoint point = casting_point(scene, instance, scene.lights[l]);
            gpu::LightData light{.slots = 0,
                                 .face_words = 0,
                                 .point = {point.x, point.y, point.z, point.w},
                                 .color = glm::vec3(1.0f / float(light_count)),
                                 .extrusion = 0.0f};
            if (scene.camera.is_orthographic())
                light.extrusion = finite_extrusion(scene.lights[l], instance, bounds);
            DrawnLight drawn_light{
                .casts_shadow = casts,
                .ends_in_one_point = point.is_direction() && light.extrusion == 0.0f};
            if (casts) {
                const ShadowChoice choice =
                    choose_shadow(scene.shadow_method, scene.shadow_form, view,
                                  {.low = box.low,
                                   .high = box.high,
                                   .is_closed_chain = state.is_closed_chain,
                                   .light = point,
                                   .extrusion = light.extrusion,
                                   .reaches_far_enough = point.is_direction() ||
                                                         light.extrusion < k_max_extrusion_times});
                drawn_light.method = choice.method;
                drawn_light.form = choice.form;
                frame.report.shadows.push_back(
                    {.instance = static_cast<std::uint32_t>(i),
                     .light = static_cast<std::uint32_t>(l),
                     .choice = choice,
                     .light_moved = !(point == light_point(instance, scene.lights[l]))});
            }
            if (drawn_light.casts_shadow && state.deforming) {
                const GpuSilhouette& found = state.deforming->light(l, point, frame.deformed);
                light.slots = found.slots().address();
                light.face_words = found.face_words().address();
                drawn_light.sides = {found.arguments().handle()};
                frame.report.shadow_edges += drawn.loose_count;
                frame.report.bytes_full += 4 * face_word_count(drawn.face_count);
            } else if (drawn_light.casts_shadow) {
                const ChangeStream& stream = follow(*state.lights[l], point, frame);
                light.slots = stream.slots().address();
                light.face_words = stream.face_words().address();
                drawn_light.sides = {stream.arguments().handle()};
                frame.report.shadow_edges += state.lights[l]->regular_count() + drawn.loose_count;
            }
            drawn_light.data = draw_data_.put(light);
            drawn.lights.push_back(drawn_light);
        }
        list.instances.push_back(std::move(drawn));
    }
    if (list.inks.empty()) list.inks.push_back(scene.palette.ink);
    plan_shadows(list, frame);
    return list;
}

// Divides each light's casters into batches that the stencil can count.
void Renderer::plan_shadows(DrawList& list, Frame& frame) {
    list.shadow_batches.resize(list.light_count);
    for (std::size_t l = 0; l < list.light_count; ++l) {
        shadow_counter_.begin();
        for (ShadowReport& shadow : frame.report.shadows) {
            if (shadow.light != l) continue;
            const InstanceState& state = instances_.all()[shadow.instance];
            if (state.deforming) {
                shadow.bound =
                    shadow_counter_.add_unseen(shadow.instance, state.mesh->face_count());
                continue;
            }
            const TrackedSilhouette& volume = *state.lights[l];
            shadow.bound = shadow_counter_.add(shadow.instance, {.mesh = &volume.mesh(),
                                                                 .silhouette = volume.silhouette(),
                                                                 .face_words = volume.face_words(),
                                                                 .light = volume.point(),
                                                                 .form = shadow.choice.form});
        }
        list.shadow_batches[l] = shadow_counter_.end();
        for (const ShadowBatch& batch : list.shadow_batches[l])
            for (const ShadowDraw& draw : batch.draws) {
                if (!draw.face_by_face) continue;
                const auto shadow = std::ranges::find_if(frame.report.shadows, [&](const auto& s) {
                    return s.light == l && s.instance == draw.instance;
                });
                ++shadow->runs;
                shadow->choice.form = ShadowForm::general;
                shadow->choice.form_reason = "more triangles may be in a row than a batch counts";
            }
    }
}

// Not the paper around what is in the picture, unless something is drawn on it.
DrawnArea Renderer::drawn_area(const Scene& scene, const PictureTarget& target) {
    const auto around = composite_of(scene.palette.background, target.format);
    if (!around || scene.palette.grid_strength > 0.0f) return DrawnArea::whole(target.extent);
    return {drawn_rect(scene, target.extent), *around};
}

void Renderer::record_passes(VkCommandBuffer commands, const Scene& scene, const DrawList& list,
                             Frame& frame, const PictureTarget& target) const {
    if (!frame.deformed.is_empty())
        frame.deformed.record(context_, commands, instances_.deform_passes());
    ChangeStream::record_before(commands);
    for (const TrackedSilhouette* silhouette : frame.silhouettes)
        silhouette->stream().record(commands, scatter_);
    ChangeStream::record_after(commands);

    targets_->record_before_surfaces(commands, target);
    const DrawnArea area = drawn_area(scene, target);
    targets_->begin_surfaces(commands, scene.palette.background, area);
    if (!list.shadows && list.light_count == 1) {
        surface_pass_.record_shadowless(commands, list);
    } else {
        surface_pass_.record_unlit(commands, list);
        for (std::size_t light = 0; light < list.light_count; ++light) {
            if (list.shadows)
                shadow_pass_.record(commands, list, light, targets_->in_pass(area.rect));
            surface_pass_.record_lit(commands, list, light);
        }
    }
    vkCmdEndRendering(commands);

    targets_->record_before_lines(commands);
    targets_->begin_lines(commands, area);
    if (scene.palette.grid_strength > 0.0f)
        ink_pass_.record_grid(commands, glm::vec4(scene.palette.grid, scene.palette.grid_strength),
                              targets_->size(), targets_->scale());
    for (std::size_t ink = 0; ink < list.inks.size(); ++ink) {
        if (ink > 0) ink_pass_.record_ink(commands, list.inks[ink - 1]);
        line_pass_.record(commands, list, ink);
    }
    vkCmdEndRendering(commands);

    targets_->record_before_picture(commands);
    RenderTargets::begin_picture(commands, target, area);
    composite_pass_.record(commands, {target.format, targets_->scale()}, list.inks.back());
    vkCmdEndRendering(commands);
    RenderTargets::record_after_picture(commands, target);
}

// What a frame needs before it begins.
void Renderer::prepare(const Scene& scene, const PictureTarget& target, Frame& frame) {
    prepare_targets(target.extent);
    composite_pass_.prepare(context_, {target.format, targets_->scale()});
    surface_pass_.prepare(context_, scene.style);
    frame.report = {};
    InstanceStates::Frames frames{.recorded = recorded_};
    for (const Frame& other : frames_)
        if (!is_done(other)) frames.first_running = std::min(frames.first_running, other.number);
    const InstanceStates::Uploaded uploaded = instances_.prepare(scene, frames);
    frame.report.meshes_uploaded = uploaded.meshes;
    frame.report.bytes_uploaded = uploaded.bytes;
}

// Everything that render() and record() share: `frame` is counted as recorded when this returns.
FrameReport Renderer::record_frame(VkCommandBuffer commands, const Scene& scene,
                                   const PictureTarget& target, Frame& frame) {
    const auto started = std::chrono::steady_clock::now();
    frame.started = started;
    frame.silhouettes.clear();
    frame.deformed.clear();
    FrameReport report;
    try {
        instances_.prepare_silhouettes(scene);
        const DrawList list = build_draw_list(scene, frame);
        record_passes(commands, scene, list, frame, target);
        if (options_.check_silhouettes) check_.record(commands, ring_slot(), frame.silhouettes);
        marks_.record(commands, ring_slot(), recorded_ + 1);
        frame.report.record_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started)
                .count();
        report = frame.report;  // Before the frame counts, for it allocates.
    } catch (...) {
        check_.forget(ring_slot());
        instances_.invalidate();
        throw;
    }
    frame.number = ++recorded_;
    return report;
}

FrameReport Renderer::record(VkCommandBuffer commands, const Scene& scene,
                             const PictureTarget& target) {
    const std::uint32_t slot = ring_slot();
    Frame& frame = frames_[slot];
    RIMLINE_CHECK(is_done(frame) && std::ranges::find(queued_, slot) == queued_.end());
    count_differences(slot);
    prepare(scene, target, frame);
    instances_.uploads().wait();  // The caller's submit knows nothing of them.
    FrameReport report = record_frame(commands, scene, target, frame);
    frame.timeline_value = 0;
    return report;
}

void Renderer::forget_recorded() noexcept {
    bool forgotten = false;
    for (Frame& frame : frames_) {
        if (frame.timeline_value != 0 || is_done(frame)) continue;
        frame.number = 0;
        check_.forget(static_cast<std::uint32_t>(&frame - frames_.data()));
        forgotten = true;
    }
    if (forgotten) instances_.invalidate();
}

void Renderer::submit(Frame& frame) {
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = frame.commands};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = timeline_,
                                       .value = submitted_ + 1,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    // Where meshes are new, on their way.
    Uploads& uploads = instances_.uploads();
    const VkSemaphoreSubmitInfo uploaded{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                         .semaphore = uploads.timeline(),
                                         .value = uploads.sent_value(),
                                         .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = uploads.is_done() ? 0u : 1u,
                               .pWaitSemaphoreInfos = &uploaded,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &commands,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &signal};
    vk_check(vkQueueSubmit2(context_.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    frame.timeline_value = ++submitted_;
}

void Renderer::submit(const Scene& scene, std::uint32_t width, std::uint32_t height) {
    RIMLINE_CHECK(queued_.size() < k_frames_in_flight);
    const std::uint32_t slot = ring_slot();
    Frame& frame = frames_[slot];
    RIMLINE_CHECK(is_done(frame) && std::ranges::find(queued_, slot) == queued_.end());
    count_differences(slot);
    frame.size = {width, height};
    prepare_picture(frame.size);
    if (frame.picture.size() < VkDeviceSize{4} * width * height)
        frame.picture = make_picture_buffer(context_, frame.size);
    const PictureTarget target = picture_target(picture_);
    prepare(scene, target, frame);
    const VkCommandBuffer commands = frame.commands;
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
    vk_check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record_frame(commands, scene, target, frame);
    try {
        record_read_back(commands, picture_.handle(), frame.size, frame.picture);
        vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        queued_.push_back(slot);  // Before what cannot be taken back.
        submit(frame);
    } catch (...) {
        if (!queued_.empty() && queued_.back() == slot) queued_.pop_back();
        frame.number = 0;
        check_.forget(slot);
        --recorded_;  // Its slot is the next one's: the other may still be in use.
        instances_.invalidate();
        throw;
    }
}

// What was not known when the frame was recorded.
void Renderer::add_deformed_counts(Frame& frame) {
    if (frame.deformed.is_empty()) return;
    const DeformedCounts lines = frame.deformed.counts(DeformedFrame::Purpose::line);
    const DeformedCounts shadows = frame.deformed.counts(DeformedFrame::Purpose::shadow);
    frame.report.silhouette += static_cast<std::uint32_t>(lines.silhouette);
    frame.report.shadow_edges += static_cast<std::uint32_t>(shadows.regular);
    frame.report.bytes_full += 4 * (lines.silhouette + shadows.silhouette);
    frame.report.camera.edges += lines.silhouette;
    frame.report.camera.flips += lines.flips;
    frame.report.camera.added += lines.added;
    frame.report.camera.removed += lines.removed;
}

Picture Renderer::finish() {
    RIMLINE_CHECK(!queued_.empty());
    const std::uint32_t slot = queued_.front();
    Frame& frame = frames_[slot];
    queued_.pop_front();
    try {
        wait_for(frame.timeline_value);
    } catch (...) {
        frame.number = 0;  // A lost device leaves no marks.
        check_.forget(slot);
        throw;
    }
    count_differences(slot);
    Picture picture = read_picture(frame.picture, frame.size);
    add_deformed_counts(frame);
    report_ = frame.report;
    report_.frame_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - frame.started)
            .count();
    return picture;
}

void Renderer::count_differences(std::uint32_t ring_slot) {
    frames_[ring_slot].report.differences = check_.take_differences(ring_slot);
    differences_ += frames_[ring_slot].report.differences;
}

const TrackedSilhouette* Renderer::silhouette(std::size_t instance,
                                              std::optional<std::size_t> light) const {
    const InstanceState& state = instances_.all().at(instance);
    return light ? state.lights.at(*light).get() : state.camera.get();
}

}  // namespace rimline
