#pragma once

// The state of a Renderer: the frames that are recorded and not yet done, and what they share.
//
// Frame n has ring slot n % ring_slots: of this ring, of every stream, and of the marks. A slot is used
// again when the GPU is done with its frame. Frames are numbered from 1 in the order of recording.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "engine/frame/draw_data.h"
#include "engine/frame/frame_passes.h"
#include "engine/frame/instance_states.h"
#include "engine/frame/pass_clock.h"
#include "engine/frame/recorded_frame.h"
#include "engine/frame/shadow_batches.h"
#include "engine/frame_report.h"
#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "engine/stream/consistency_check.h"
#include "engine/vulkan/frame_marks.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/upload_point.h"
#include "silhouette/picture.h"

namespace rimline {

/// The functions are Renderer's; their contracts stand there.
class FramesInFlight {
public:
    FramesInFlight(const DeviceContext& context, const RendererOptions& options);
    ~FramesInFlight();
    FramesInFlight(const FramesInFlight&) = delete;
    FramesInFlight& operator=(const FramesInFlight&) = delete;

    void submit(const Scene& scene, VkExtent2D size);
    Picture finish();
    UploadPoint prepare(const Scene& scene, const PictureTarget& target);
    FrameReport record(VkCommandBuffer commands, VkCommandBuffer picture, const Scene& scene,
                       const PictureTarget& target);
    void forget_recorded() noexcept;

    void announce(const Scene& scene) noexcept { instances_.announce(scene); }
    void set_scale(std::uint32_t scale) noexcept { passes_.set_scale(scale); }

    const FrameReport& report() const noexcept { return report_; }
    std::optional<SilhouetteBuffers> silhouette(std::size_t instance,
                                                std::optional<std::size_t> light) const;
    std::uint64_t differences() const noexcept { return differences_; }
    std::uint64_t stream_bytes() const noexcept { return instances_.stream_bytes(); }
    std::uint64_t tracker_bytes() const noexcept { return instances_.tracker_bytes(); }
    const RenderTargets* targets() const noexcept { return passes_.targets(); }

private:
    // What a frame owns until it is done.
    struct Frame {
        std::uint64_t number = 0;                   // 0: there is no frame to wait for.
        VkCommandBuffer commands = VK_NULL_HANDLE;  // This and the next three for submit() only.
        std::uint64_t timeline_value = 0;           // 0: a caller submits the frame.
        Buffer picture;
        VkExtent2D size{};
        RecordedFrame recorded;
    };

    std::uint32_t ring_slot() const noexcept {
        return static_cast<std::uint32_t>(recorded_ % frames_.size());
    }
    void wait_for(std::uint64_t timeline_value) const;
    bool is_done(std::uint32_t slot) const noexcept;
    bool is_complete(std::uint32_t slot) const noexcept;
    Frame& free_frame(std::uint32_t slot);
    void prepare_scene(const Scene& scene, const PictureTarget& target);
    void prepare_targets(const Scene& scene, const PictureTarget& target);
    void prepare_picture(VkExtent2D size);
    FrameReport record_frame(Commands commands, Commands picture, const Scene& scene,
                             const PictureTarget& target, Frame& frame, bool is_callers);
    void record_silhouettes(Commands commands, RecordedFrame& frame) const;
    void record_submission(const Scene& scene, Frame& frame);
    void enqueue(Frame& frame);
    void take_back(std::uint32_t slot) noexcept;
    void count_differences(std::uint32_t slot);

    DeviceContext context_;
    std::unique_ptr<SilhouetteService> own_service_;
    ScatterPass scatter_;
    DrawData draw_data_;
    FramePasses passes_;
    OwnedSemaphore timeline_;
    OwnedCommandPool command_pool_;
    std::vector<Frame> frames_;
    FrameMarks marks_;
    PassClock clock_;
    bool limits_shadows_;
    bool lists_fronts_;
    bool checks_silhouettes_;
    ConsistencyCheck check_;
    std::uint64_t recorded_ = 0;         // Frames so far.
    InstanceStates::Uploaded uploaded_;  // For the report of the next frame.
    std::uint64_t awaited_uploads_ = 0;  // The uploads' value that the last submission waits for.
    std::uint64_t submitted_ = 0;        // Of these, by submit(): the timeline's last value.
    std::deque<std::uint32_t> queued_;   // Ring slots of those submitted and not finished.
    Image picture_;                      // The target of submit().
    InstanceStates instances_;
    ShadowBatches shadow_batches_;
    std::uint64_t differences_ = 0;
    FrameReport report_;
};

}  // namespace rimline
