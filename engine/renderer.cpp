#include "engine/renderer.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace rimline {

namespace {

static_assert(static_cast<int>(Style::ink) == RIMLINE_STYLE_INK &&
              static_cast<int>(Style::toon) == RIMLINE_STYLE_TOON &&
              static_cast<int>(Style::mask) == RIMLINE_STYLE_MASK);

// A light's volumes in an orthographic view reach behind everything there is, and no farther than that
// needs: what they stretch over costs the depth of their sides its precision.
constexpr double k_greatest_extrusion_times = 65536.0;
constexpr double k_finite_extrusion_radii = 8.0;

// How far behind its surface a line may lie, of its distance from the viewer or of the scene's depth:
// a hundred times the rounding of depth, a hundredth of a pixel on a usual picture.
constexpr float k_depth_slack = 1e-5f;

AttachmentFormats surface_formats(std::uint32_t samples) {
    return {k_surface_format, k_depth_stencil_format, samples};
}

RendererOptions fitted(const DeviceContext& context, RendererOptions options) {
    options.samples = std::min(options.samples, context.samples);
    return options;
}

OwnedSemaphore make_timeline(const DeviceContext& context) {
    const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                         .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                     .pNext = &type};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk_check(vkCreateSemaphore(context.device, &info, nullptr, &semaphore), "vkCreateSemaphore");
    return {context.device, semaphore};
}

OwnedCommandPool make_command_pool(const DeviceContext& context) {
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = context.queue_family};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateCommandPool(context.device, &info, nullptr, &pool), "vkCreateCommandPool");
    return {context.device, pool};
}

// Points of the world in an instance's own coordinates.
glm::dvec3 point_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * (world - instance.translation);
}
glm::dvec3 direction_in_object(const SceneInstance& instance, const glm::dvec3& world) {
    return glm::transpose(instance.rotation) * world;
}

HomogeneousPoint camera_point(const SceneInstance& instance, const Camera& camera) {
    if (!camera.is_orthographic())
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, camera.eye)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(camera.eye - camera.target))));
}

HomogeneousPoint light_point(const SceneInstance& instance, const Light& light) {
    if (!light.directional)
        return HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, light.vector)));
    return HomogeneousPoint::direction(
        glm::vec3(direction_in_object(instance, glm::normalize(light.vector))));
}

// LightData.extrusion for an orthographic view. A point light's volume begins no nearer to it than the
// sphere around its caster, and must end no nearer than the far side of the sphere around the scene.
float finite_extrusion(const Light& light, const SceneInstance& instance,
                       const SceneBounds& bounds) {
    if (light.directional) return float(k_finite_extrusion_radii * bounds.radius);
    const Mesh& mesh = instance.octree->mesh();
    const glm::dvec3 middle = instance.rotation * mesh.center() + instance.translation;
    const double begin = glm::distance(light.vector, middle) - mesh.radius();
    const double end = glm::distance(light.vector, bounds.center) + 1.01 * bounds.radius;
    if (begin * k_greatest_extrusion_times <= end) return float(k_greatest_extrusion_times);
    return float(end / begin);
}

// Where in a pixel the first of its samples lies (Vulkan's standard sample locations).
glm::vec2 first_sample_place(std::uint32_t samples) {
    if (samples == 4) return {0.375f, 0.125f};
    return samples == 2 ? glm::vec2(0.75f, 0.75f) : glm::vec2(0.5f, 0.5f);
}

std::uint32_t regular_edges(const Mesh& mesh, std::span<const EdgeId> edges) {
    const std::uint32_t end = mesh.edges_of_class(EdgeClass::regular).last;
    return static_cast<std::uint32_t>(
        std::ranges::count_if(edges, [end](EdgeId edge) { return index(edge) < end; }));
}

gpu::FrameData frame_data(const Scene& scene, const RenderTargets& targets) {
    const VkExtent2D extent = targets.pass_extent();
    const SceneBounds bounds = bounds_of(scene);
    const Projection projection = make_projection(
        scene.camera, double(extent.width) / extent.height, bounds.center, bounds.radius);
    const bool orthographic = scene.camera.is_orthographic();
    return {.clip_scale = glm::vec2(projection.scale),
            .clip_z = glm::vec2(projection.z),
            .clip_w = glm::vec2(projection.w),
            .viewport = {float(extent.width), float(extent.height)},
            .depth_place = first_sample_place(targets.samples()),
            .line_radius = 0.5f * scene.line_width_px * float(targets.scale()),
            .depth_slack = orthographic ? 0.0f : k_depth_slack,
            .depth_slack_absolute = orthographic ? k_depth_slack : 0.0f,
            .style = static_cast<std::uint32_t>(scene.style),
            .background = scene.palette.background,
            .shade = scene.palette.shade};
}

gpu::InstanceData instance_data(const SceneInstance& instance, const GpuMesh& mesh,
                                const Camera& camera, VkDeviceAddress slots) {
    // The camera's silhouette point and the position that vertices are taken relative to are one and
    // the same float.
    const HomogeneousPoint eye =
        HomogeneousPoint::viewpoint(glm::vec3(point_in_object(instance, camera.eye)));
    return {.positions = mesh.positions(),
            .triangles = mesh.triangles(),
            .corner_normals = mesh.corner_normals(),
            .edges = mesh.edges(),
            .loose_edges = mesh.loose_edges(),
            .borders = mesh.borders(),
            .slots = slots,
            .eye_from_object = glm::mat3(camera_from_world(camera) * instance.rotation),
            .camera = eye.xyz(),
            .color = instance.color,
            .fade_radius = float(instance.fade_radius),
            .fade_center = glm::vec3(point_in_object(instance, instance.fade_center)),
            .padding = 0};
}

}  // namespace

Renderer::Renderer(const DeviceContext& context, const RendererOptions& options)
    : context_(context),
      options_(fitted(context, options)),
      scatter_(context),
      surface_pass_(context, surface_formats(options_.samples)),
      shadow_pass_(context, surface_formats(options_.samples)),
      line_pass_(context, k_coverage_format),
      composite_pass_(context, k_picture_format),
      timeline_(make_timeline(context)),
      command_pool_(make_command_pool(context)) {
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

void Renderer::wait_for(std::uint64_t frame_count) const {
    const VkSemaphore semaphore = timeline_;
    const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                   .semaphoreCount = 1,
                                   .pSemaphores = &semaphore,
                                   .pValues = &frame_count};
    vk_check(vkWaitSemaphores(context_.device, &info, UINT64_MAX), "vkWaitSemaphores");
}

void Renderer::prepare_targets(VkExtent2D size) {
    if (targets_ && targets_->size().width == size.width && targets_->size().height == size.height)
        return;
    wait_for(submitted_);
    targets_.reset();  // Free before making anew.
    targets_ = std::make_unique<RenderTargets>(
        context_, size, fitting_scale(context_, size, options_.scale, options_.samples),
        options_.samples);
    line_pass_.set_surface_depth(targets_->depth());
    composite_pass_.set_images(targets_->surfaces(), targets_->lines());
}

void Renderer::prepare_instances(const Scene& scene) {
    const auto is_kept = [&](std::size_t i) {
        return instances_[i].octree == scene.instances[i].octree &&
               instances_[i].lights.size() <= scene.lights.size();
    };
    bool all_kept = instances_.size() <= scene.instances.size();
    for (std::size_t i = 0; i < instances_.size() && all_kept; ++i) all_kept = is_kept(i);
    // Frames in flight may still read what goes.
    if (!all_kept) wait_for(submitted_);

    instances_.resize(scene.instances.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        InstanceState& state = instances_[i];
        const HoughOctree* octree = scene.instances[i].octree;
        if (state.octree != octree) {
            std::unique_ptr<GpuMesh>& mesh = meshes_[&octree->mesh()];
            if (!mesh)
                mesh =
                    std::make_unique<GpuMesh>(context_, octree->mesh(), options_.crease_angle_rad);
            state = {.octree = octree, .mesh = mesh.get()};
        }
        state.lights.resize(scene.lights.size());
    }
    if (all_kept) return;
    std::erase_if(meshes_, [&](const auto& entry) {
        return std::ranges::none_of(instances_, [&](const InstanceState& state) {
            return state.mesh == entry.second.get();
        });
    });
}

const ChangeStream& Renderer::follow(std::unique_ptr<Tracked>& tracked, const HoughOctree& octree,
                                     const HomogeneousPoint& point, Frame& frame) {
    bool sent = false;
    if (!tracked) {
        tracked = std::make_unique<Tracked>(
            Tracked{SilhouetteTracker(octree, point),
                    ChangeStream(context_, octree.mesh(), k_frames_in_flight)});
        tracked->stream.begin_frame(ring_slot());
    } else {
        tracked->stream.begin_frame(ring_slot());
        sent = tracked->stream.apply(tracked->tracker.move_to(point));
    }
    if (!sent)
        tracked->stream.resend(tracked->tracker.sequence(), tracked->tracker.silhouette(),
                               tracked->tracker.face_words());
    frame.streams.push_back(&tracked->stream);
    frame.report.bytes_streamed += tracked->stream.bytes_streamed();
    frame.report.bytes_full += tracked->stream.bytes_full();
    return tracked->stream;
}

DrawList Renderer::build_draw_list(const Scene& scene, Frame& frame) {
    const std::size_t light_count = scene.lights.size();
    const std::uint64_t instances_at = sizeof(gpu::FrameData);
    // Addresses need multiples of 8.
    static_assert(sizeof(gpu::FrameData) % 8 == 0 && sizeof(gpu::InstanceData) % 8 == 0);
    const std::uint64_t lights_at =
        instances_at + sizeof(gpu::InstanceData) * scene.instances.size();
    const std::uint64_t size =
        lights_at + sizeof(gpu::LightData) * scene.instances.size() * light_count;
    if (frame.data.size() < size)
        frame.data = Buffer(context_, size, BufferPlace::upload, "frame data");
    const auto put = [&](std::uint64_t offset, const auto& value) {
        std::memcpy(frame.data.mapped() + offset, &value, sizeof value);
        return frame.data.address() + offset;
    };

    DrawList list{.frame = put(0, frame_data(scene, *targets_)),
                  .light_count = light_count,
                  .shadows = scene.shadows,
                  .instances = {}};
    const SceneBounds bounds = bounds_of(scene);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const SceneInstance& instance = scene.instances[i];
        InstanceState& state = instances_[i];
        DrawnInstance drawn{.data = 0,
                            .face_count = state.mesh->face_count(),
                            .border_count = state.mesh->border_count(),
                            .loose_count = state.mesh->loose_count(),
                            .has_lines = scene.lines && instance.has_lines,
                            .silhouette = {},
                            .lights = {}};
        VkDeviceAddress slots = 0;
        if (drawn.has_lines) {
            const ChangeStream& stream =
                follow(state.camera, *instance.octree, camera_point(instance, scene.camera), frame);
            slots = stream.slots().address();
            drawn.silhouette = {stream.arguments().handle()};
            frame.report.silhouette += stream.silhouette_size() + drawn.border_count;
        }
        drawn.data = put(instances_at + i * sizeof(gpu::InstanceData),
                         instance_data(instance, *state.mesh, scene.camera, slots));
        for (std::size_t l = 0; l < light_count; ++l) {
            const HomogeneousPoint point = light_point(instance, scene.lights[l]);
            gpu::LightData light{.slots = 0,
                                 .face_words = 0,
                                 .light = {point.x, point.y, point.z, point.w},
                                 .color = glm::vec3(1.0f / float(light_count)),
                                 .extrusion = 0.0f};
            if (scene.camera.is_orthographic())
                light.extrusion = finite_extrusion(scene.lights[l], instance, bounds);
            DrawnLight drawn_light{
                .casts_shadow = scene.shadows && instance.casts_shadows,
                .ends_in_one_point = point.is_direction() && light.extrusion == 0.0f};
            if (drawn_light.casts_shadow) {
                const ChangeStream& stream =
                    follow(state.lights[l], *instance.octree, point, frame);
                light.slots = stream.slots().address();
                light.face_words = stream.face_words().address();
                drawn_light.sides = {stream.arguments().handle()};
                frame.report.shadow_edges +=
                    regular_edges(instance.octree->mesh(), state.lights[l]->tracker.silhouette()) +
                    drawn.loose_count;
            }
            drawn_light.data =
                put(lights_at + (i * light_count + l) * sizeof(gpu::LightData), light);
            drawn.lights.push_back(drawn_light);
        }
        list.instances.push_back(std::move(drawn));
    }
    return list;
}

void Renderer::record(const Scene& scene, const DrawList& list, const Frame& frame) const {
    const VkCommandBuffer commands = frame.commands;
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vkResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
    vk_check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    ChangeStream::record_before(commands);
    for (const ChangeStream* stream : frame.streams) stream->record(commands, scatter_);
    ChangeStream::record_after(commands);

    const VkExtent2D extent = targets_->pass_extent();
    targets_->record_before_surfaces(commands);
    const glm::vec4 background(scene.palette.background, 1.0f);
    targets_->begin_surfaces(commands, &background[0]);
    surface_pass_.record_unlit(commands, list);
    for (std::size_t light = 0; light < list.light_count; ++light) {
        if (list.shadows) shadow_pass_.record(commands, list, light, extent);
        surface_pass_.record_lit(commands, list, light);
    }
    vkCmdEndRendering(commands);

    targets_->record_before_lines(commands);
    targets_->begin_lines(commands);
    if (scene.lines) line_pass_.record(commands, list);
    vkCmdEndRendering(commands);

    targets_->record_before_picture(commands);
    targets_->begin_picture(commands);
    composite_pass_.record(commands, glm::vec4(scene.palette.ink, scene.hidden_line_strength),
                           targets_->scale());
    vkCmdEndRendering(commands);
    targets_->record_readback(commands, frame.picture);
    vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
}

void Renderer::submit(const Frame& frame) {
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = frame.commands};
    const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = timeline_,
                                       .value = submitted_ + 1,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &commands,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &signal};
    vk_check(vkQueueSubmit2(context_.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    ++submitted_;
}

// What a frame that failed has queued never ran, though its trackers have moved.
void Renderer::forget_gpu_state() noexcept {
    for (InstanceState& state : instances_) {
        if (state.camera) state.camera->stream.invalidate();
        for (const auto& light : state.lights)
            if (light) light->stream.invalidate();
    }
}

void Renderer::submit(const Scene& scene, std::uint32_t width, std::uint32_t height) {
    RIMLINE_CHECK(submitted_ - finished_ < k_frames_in_flight);
    prepare_targets({width, height});
    prepare_instances(scene);
    Frame& frame = frames_[ring_slot()];
    frame.started = std::chrono::steady_clock::now();
    frame.report = {};
    frame.streams.clear();
    frame.size = {width, height};
    const VkDeviceSize picture_bytes = VkDeviceSize{4} * width * height;
    if (frame.picture.size() < picture_bytes)
        frame.picture = Buffer(context_, picture_bytes, BufferPlace::readback, "the picture");
    try {
        const DrawList list = build_draw_list(scene, frame);
        record(scene, list, frame);
        submit(frame);
    } catch (...) {
        forget_gpu_state();
        throw;
    }
}

Picture Renderer::finish() {
    RIMLINE_CHECK(finished_ < submitted_);
    Frame& frame = frames_[finished_ % k_frames_in_flight];
    wait_for(++finished_);
    Picture picture{frame.size.width, frame.size.height, {}};
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(frame.picture.mapped());
    picture.rgba.assign(pixels, pixels + std::size_t{4} * picture.width * picture.height);
    report_ = frame.report;
    report_.frame_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - frame.started)
            .count();
    return picture;
}

const Renderer::Tracked* Renderer::find(std::size_t instance,
                                        std::optional<std::size_t> light) const {
    const InstanceState& state = instances_.at(instance);
    return light ? state.lights.at(*light).get() : state.camera.get();
}

const SilhouetteTracker* Renderer::tracker(std::size_t instance,
                                           std::optional<std::size_t> light) const {
    const Tracked* tracked = find(instance, light);
    return tracked ? &tracked->tracker : nullptr;
}

const ChangeStream* Renderer::stream(std::size_t instance, std::optional<std::size_t> light) const {
    const Tracked* tracked = find(instance, light);
    return tracked ? &tracked->stream : nullptr;
}

}  // namespace rimline
