#include "engine/frame/frames_in_flight.h"

#include <algorithm>

#include "engine/frame/draw_list_builder.h"
#include "engine/frame/scene_check.h"
#include "engine/frame/scene_data.h"
#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/debug_names.h"

namespace rimline {

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

// Adds to the report what the GPU counted of instances that deform. The GPU must be done with the frame.
void add_deformed_counts(RecordedFrame& frame) {
    if (frame.deformed.is_empty()) return;
    const DeformedCounts lines = frame.deformed.counts(DeformedFrame::Purpose::line);
    const DeformedCounts shadows = frame.deformed.counts(DeformedFrame::Purpose::shadow);
    FrameReport& report = frame.report;
    report.silhouette += static_cast<std::uint32_t>(lines.silhouette);
    report.shadow_edges += static_cast<std::uint32_t>(shadows.regular);
    report.bytes_full += 4 * (lines.silhouette + shadows.silhouette);
    report.camera.edges += lines.silhouette;
    report.camera.flips += lines.flips;
    report.camera.added += lines.added;
    report.camera.removed += lines.removed;
}

}  // namespace

FramesInFlight::FramesInFlight(const DeviceContext& context, const RendererOptions& options)
    : context_(context),
      own_service_(options.service ? nullptr : std::make_unique<SilhouetteService>()),
      scatter_(context),
      draw_data_(context, options.frames_in_flight),
      passes_(context, options, draw_data_.layout()),
      timeline_(make_timeline(context, "frames")),
      command_pool_(make_command_pool(context, "frames", context.queue_family)),
      frames_(options.frames_in_flight),
      marks_(context, options.frames_in_flight),
      clock_(context, options.frames_in_flight, options.pass_times),
      limits_shadows_(options.limits_shadows),
      lists_fronts_(context.type == VK_PHYSICAL_DEVICE_TYPE_CPU),
      checks_silhouettes_(options.check_silhouettes),
      check_(context, options.frames_in_flight),
      instances_(context, options.service ? *options.service : *own_service_,
                 {.crease_angle_rad = options.crease_angle_rad,
                  .line_path = passes_.line_path(),
                  .outline = options.outline.method,
                  .ring_slots = options.frames_in_flight,
                  .stream_memory_bytes = options.stream_memory_bytes,
                  .tracker_memory_bytes = options.tracker_memory_bytes}) {
    for (Frame& frame : frames_) frame.commands = make_commands(context, command_pool_);
}

FramesInFlight::~FramesInFlight() {
    try {
        wait_for(submitted_);
    } catch (const Error&) {
        // A lost device runs nothing any more.
    }
}

void FramesInFlight::wait_for(std::uint64_t timeline_value) const {
    wait_for_timeline(context_, timeline_, timeline_value);
}

bool FramesInFlight::is_done(std::uint32_t slot) const noexcept {
    return frames_[slot].number == 0 || marks_.has(slot, frames_[slot].number);
}

// Whether all commands of its command buffer have ended, which may go on after the mark. Of a caller's frame that is
// known only when its slot is used again.
bool FramesInFlight::is_complete(std::uint32_t slot) const noexcept {
    const Frame& frame = frames_[slot];
    if (frame.number == 0) return true;
    std::uint64_t reached = 0;
    return frame.timeline_value != 0 &&
           context_.vk->GetSemaphoreCounterValue(context_.device, timeline_, &reached) ==
               VK_SUCCESS &&
           reached >= frame.timeline_value;
}

// The frame of `slot`, which nothing may use any more, for a new frame.
FramesInFlight::Frame& FramesInFlight::free_frame(std::uint32_t slot) {
    RIMLINE_CHECK(is_done(slot) && std::ranges::find(queued_, slot) == queued_.end());
    count_differences(slot);
    return frames_[slot];
}

void FramesInFlight::prepare_targets(const Scene& scene, const PictureTarget& target) {
    if (passes_.has_targets_for(scene, target)) return;
    wait_for(submitted_);
    for (std::uint32_t slot = 0; slot < frames_.size(); ++slot)
        if (frames_[slot].timeline_value == 0 && !is_done(slot))
            throw Error(ErrorCode::bad_input,
                        "prepare(): a target of another size or scale, the first layer and a "
                        "backdrop that comes or goes need other images, while frames that were "
                        "recorded before still use these: wait for them");
    passes_.make_targets(scene, target);
}

void FramesInFlight::prepare_picture(VkExtent2D size) {
    const VkExtent2D old = picture_.description().extent;
    if (old.width == size.width && old.height == size.height) return;
    wait_for(submitted_);
    picture_ = {};  // Frees its memory before the new one is made.
    picture_ = make_picture_image(context_, size);
}

// Makes everything that a frame needs before its recording begins, but silhouettes.
void FramesInFlight::prepare_scene(const Scene& scene, const PictureTarget& target) {
    check_scene(scene);
    prepare_targets(scene, target);
    passes_.prepare(scene, target);
    InstanceStates::Frames numbers{.recorded = recorded_};
    for (std::uint32_t slot = 0; slot < frames_.size(); ++slot)
        if (!is_complete(slot))
            numbers.first_running = std::min(numbers.first_running, frames_[slot].number);
    instances_.prepare(scene, numbers, uploaded_);
}

UploadPoint FramesInFlight::prepare(const Scene& scene, const PictureTarget& target) {
    prepare_scene(scene, target);
    instances_.prepare_silhouettes(FrameView(scene, target.extent, instances_.casters()));
    return instances_.uploads().sent();
}

// The part that submit() and record() share. When it returns, `frame` counts as recorded. A caller has
// prepared silhouettes; for own frames they are made here.
FrameReport FramesInFlight::record_frame(Commands commands, Commands picture, const Scene& scene,
                                         const PictureTarget& target, Frame& frame,
                                         bool is_callers) {
    const std::uint32_t slot = ring_slot();
    RecordedFrame& recorded = frame.recorded;
    recorded.started = std::chrono::steady_clock::now();
    recorded.silhouettes.clear();
    recorded.buffers.clear();
    recorded.deformed.clear();
    recorded.report = {.meshes_uploaded = uploaded_.meshes, .bytes_uploaded = uploaded_.bytes};
    if (is_callers) recorded.report.passes = clock_.take(slot);
    FrameReport report;
    try {
        const FrameView view(scene, target.extent, instances_.casters());
        RIMLINE_CHECK(!is_callers || instances_.has_silhouettes(view));
        const auto sending = std::chrono::steady_clock::now();
        instances_.prepare_silhouettes(view);
        recorded.report.follow_ms = milliseconds_since(sending);
        const DrawList list =
            build_draw_list(view, frame_data(view, *passes_.targets()), slot,
                            {instances_, draw_data_, shadow_batches_, target, passes_.line_path(),
                             passes_.outline(), *passes_.targets(), limits_shadows_, lists_fronts_},
                            recorded);
        clock_.start(commands, slot, FramePasses::max_passes(scene) + 1);
        record_silhouettes(commands, recorded);
        clock_.end_pass(commands, "silhouettes");
        passes_.record(commands, picture, view, list, target, slot, clock_);
        if (checks_silhouettes_) check_.record(picture, slot, recorded.silhouettes);
        marks_.record(picture, slot, recorded_ + 1);
        recorded.report.record_ms = milliseconds_since(recorded.started);
        report = recorded.report;  // Copied before the frame counts, because it allocates.
    } catch (...) {
        check_.forget(slot);
        clock_.forget(slot);
        instances_.invalidate();
        throw;
    }
    uploaded_ = {};
    frame.number = ++recorded_;
    return report;
}

// Makes slots, face bits and draw arguments of all silhouettes complete on the GPU.
void FramesInFlight::record_silhouettes(Commands commands, RecordedFrame& frame) const {
    const PassLabel label(commands, "silhouettes");
    if (!frame.deformed.is_empty())
        frame.deformed.record(context_, commands, instances_.deform_passes());
    // Where nothing changes, no draw waits for the frame before.
    if (std::ranges::none_of(frame.silhouettes, [](const TrackedSilhouette* silhouette) {
            return silhouette->stream().has_changes();
        }))
        return;
    ChangeStream::record_before(commands);
    for (const TrackedSilhouette* silhouette : frame.silhouettes)
        silhouette->stream().record(commands, scatter_);
    ChangeStream::record_after(commands);
}

FrameReport FramesInFlight::record(VkCommandBuffer commands, VkCommandBuffer picture,
                                   const Scene& scene, const PictureTarget& target) {
    check_scene(scene);
    check_target(target);
    RIMLINE_CHECK(commands != VK_NULL_HANDLE && picture != VK_NULL_HANDLE);
    Frame& frame = free_frame(ring_slot());
    RIMLINE_CHECK(passes_.has_targets_for(scene, target) && passes_.is_prepared(scene, target) &&
                  instances_.is_prepared(scene));
    FrameReport report =
        record_frame({*context_.vk, commands}, {*context_.vk, picture}, scene, target, frame, true);
    frame.timeline_value = 0;
    return report;
}

void FramesInFlight::forget_recorded() noexcept {
    bool forgotten = false;
    for (std::uint32_t slot = 0; slot < frames_.size(); ++slot) {
        if (frames_[slot].timeline_value != 0 || is_done(slot)) continue;
        frames_[slot].number = 0;
        check_.forget(slot);
        clock_.forget(slot);
        forgotten = true;
    }
    if (forgotten) instances_.invalidate();
}

void FramesInFlight::submit(const Scene& scene, VkExtent2D size) {
    RIMLINE_CHECK(size.width > 0 && size.height > 0);
    RIMLINE_CHECK(queued_.size() < frames_.size());
    const std::uint32_t slot = ring_slot();
    Frame& frame = free_frame(slot);
    frame.size = size;
    prepare_picture(size);
    if (frame.picture.size() < VkDeviceSize{4} * size.width * size.height)
        frame.picture = make_picture_buffer(context_, size);
    record_submission(scene, frame);
    try {
        record_read_back({*context_.vk, frame.commands}, picture_.handle(), size, frame.picture);
        vk_check(context_.vk->EndCommandBuffer(frame.commands), "vkEndCommandBuffer");
        queued_.push_back(slot);  // May throw, so before the submission, which cannot be undone.
        enqueue(frame);
    } catch (...) {
        take_back(slot);
        throw;
    }
}

// Records the frame into its own command buffer, which is left open.
void FramesInFlight::record_submission(const Scene& scene, Frame& frame) {
    PictureTarget target = picture_target(picture_);
    if (!scene.has_background) target.use = PictureUse::straight;
    prepare_scene(scene, target);
    const Commands commands = begin_commands(context_, frame.commands);
    record_frame(commands, commands, scene, target, frame, false);
}

// Submits the frame's commands. They wait for uploads in progress and signal the next timeline value.
void FramesInFlight::enqueue(Frame& frame) {
    const UploadPoint uploaded = instances_.uploads().sent();
    Submission submission{.queue = context_.queue,
                          .commands = frame.commands,
                          .signal = SemaphorePoint{timeline_, submitted_ + 1}};
    // Also if they are done: only the semaphore makes them visible. Later submissions come after this one.
    if (uploaded.value > awaited_uploads_) submission.waits.push_back(uploaded);
    submit_commands(context_, submission);
    awaited_uploads_ = uploaded.value;
    frame.timeline_value = ++submitted_;
}

// Undoes the recording of the frame in `slot`, which was not submitted.
void FramesInFlight::take_back(std::uint32_t slot) noexcept {
    if (!queued_.empty() && queued_.back() == slot) queued_.pop_back();
    frames_[slot].number = 0;
    check_.forget(slot);
    clock_.forget(slot);
    --recorded_;  // The next frame gets the same slot: the other slot may still be in use.
    instances_.invalidate();
}

Picture FramesInFlight::finish() {
    RIMLINE_CHECK(!queued_.empty());
    const std::uint32_t slot = queued_.front();
    Frame& frame = frames_[slot];
    queued_.pop_front();
    try {
        wait_for(frame.timeline_value);
    } catch (...) {
        frame.number = 0;  // A lost device leaves no marks.
        check_.forget(slot);
        clock_.forget(slot);
        throw;
    }
    count_differences(slot);
    Picture picture = read_picture(frame.picture, frame.size);
    add_deformed_counts(frame.recorded);
    report_ = frame.recorded.report;
    report_.passes = clock_.take(slot);
    report_.frame_ms = milliseconds_since(frame.recorded.started);
    return picture;
}

void FramesInFlight::count_differences(std::uint32_t slot) {
    FrameReport& report = frames_[slot].recorded.report;
    report.differences = check_.take_differences(slot);
    differences_ += report.differences;
}

std::optional<SilhouetteBuffers> FramesInFlight::silhouette(
    std::size_t instance, std::optional<std::size_t> light) const {
    if (recorded_ == 0) return std::nullopt;
    const Frame& last = frames_[(recorded_ - 1) % frames_.size()];
    return last.number == recorded_ ? last.recorded.buffers_of(instance, light) : std::nullopt;
}

}  // namespace rimline
