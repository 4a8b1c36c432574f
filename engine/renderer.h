#pragma once

// Draws scenes: one tracked silhouette for each pair of an instance and a silhouette point, the camera
// or a light; a frame moves the trackers, streams what changed, and records the passes. Trackers move
// on the threads of a SilhouetteService: side by side within a frame, and for a frame that is announced
// while the GPU draws the one before.
//
//     move trackers --> streams --> surfaces, unlit --> for each light: volumes, surfaces, lit
//                                   --> grid, lines, ink --> composite --> picture
//
// There are two ways to a picture. render(), or its halves submit() and finish(), submit to the queue
// and read the picture back. record() writes the same commands into a caller's command buffer, drawing
// into a caller's image, and leaves the queue to the caller.

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "engine/frame/draw_data.h"
#include "engine/frame/draw_list.h"
#include "engine/frame/instance_states.h"
#include "engine/frame/render_targets.h"
#include "engine/frame/shadow_batches.h"
#include "engine/passes/composite_pass.h"
#include "engine/passes/ink_pass.h"
#include "engine/passes/line_pass.h"
#include "engine/passes/shadow_volume_pass.h"
#include "engine/passes/surface_pass.h"
#include "engine/scene.h"
#include "engine/stream/consistency_check.h"
#include "engine/vulkan/frame_marks.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/picture.h"

namespace rimline {

struct RendererOptions {
    /// Samples a pixel of the surface pass, 1, 2 or 4; no more than the device has are taken.
    std::uint32_t samples = 4;
    /// Pixels of every pass along each side of a pixel of the picture.
    std::uint32_t scale = 2;
    /// Shading is smooth across edges that bend by no more than this.
    float crease_angle_rad = 0.7f;
    /// Pixels are the same but for what SideStage says.
    SideStage shadow_sides = SideStage::vertex;
    /// What all silhouettes on the GPU may take together (StreamSize, change_stream.h): 80 MiB for each
    /// silhouette point of a mesh of 10 million faces. What deforms counts with its silhouettes, its moved
    /// positions and normals, and what finds them (deforming_mesh.h).
    std::uint64_t stream_memory_bytes = std::uint64_t{1} << 30;
    /// What all trackers may reserve together (SilhouetteTracker::size_bytes()): about 80 bytes a face for
    /// each silhouette point, most of which is not touched before a move of that size comes.
    std::uint64_t tracker_memory_bytes = std::uint64_t{16} << 30;
    /// Moves the trackers, for several renderers if so wished; must outlive them. Null: one of its own.
    SilhouetteService* service = nullptr;
    /// Reads slots, face bits and draw arguments back every frame and compares them with the trackers
    /// (consistency_check.h).
    bool check_silhouettes = false;
    /// How lines are drawn. The comparators (line_path.h) throw Error{no_device} where they need
    /// geometry shaders and the device has none.
    LinePath line_path = LinePath::geometry;
};

/// How one caster's shadow from one light was drawn.
struct ShadowReport {
    std::uint32_t instance = 0;
    std::uint32_t light = 0;
    ShadowChoice choice;
    /// No more triangles than this are in a row from the light, by shadow_batches.h.
    std::uint32_t bound = 0;
    /// Drawn in so many runs of faces that each cast for itself, in the general form; 0: whole.
    std::uint32_t runs = 0;
    /// The light lay exactly on a vertex, and was moved (light_off_vertices).
    bool light_moved = false;
};

/// What a frame took. What the GPU finds by itself of instances that deform is counted when the frame is
/// finished: a frame that a caller submits has no such counts.
struct FrameReport {
    /// The camera's silhouette edges and borders drawn as lines; of a line path without slots, which
    /// knows no silhouette, the borders alone.
    std::uint32_t silhouette = 0;
    std::uint32_t creases = 0;  ///< Creases drawn as lines, on the silhouette or not.
    /// Sides of shadow volumes over all lights: regular silhouette edges, and any other edge once for
    /// each of its faces.
    std::uint32_t shadow_edges = 0;
    std::vector<ShadowReport> shadows;  ///< Each caster before each light.
    std::uint64_t bytes_streamed = 0;   ///< What went to the GPU for silhouettes and face bits.
    std::uint64_t bytes_full = 0;       ///< What sending them whole would have cost.
    /// From moving the trackers to the last command recorded, by the clock. Uploading a mesh drawn for
    /// the first time is not in it; extracting the first silhouettes is.
    double record_ms = 0.0;
    std::uint32_t meshes_uploaded = 0;  ///< Those drawn for the first time, ...
    std::uint64_t bytes_uploaded = 0;   ///< ... and what went to the GPU of them.
    /// The same up to the finished picture; 0 for a frame that a caller submits.
    double frame_ms = 0.0;
    SilhouetteChanges camera;  ///< Of the silhouettes drawn as lines, over all instances.
    /// With options.check_silhouettes: words on the GPU that differ from what the trackers say. Of a frame
    /// that a caller submits they are known later, to Renderer::differences().
    std::uint64_t differences = 0;
};

class Renderer {
public:
    /// The context's device must outlive the renderer.
    Renderer(const DeviceContext& context, const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws `scene` as a picture of the given size, and waits for it. Trackers and streams are kept
    /// from one call to the next for an instance that has the same octree at its index, and there for
    /// lights by theirs; meshes as long as each scene has them. An octree must not be replaced by
    /// another at its address in between. A mesh that deforms is kept likewise, by its address; its lines
    /// need a line path that draws slots (RendererOptions::line_path). Where the device cannot hold
    /// options.scale pixels along each side of a pixel, fewer are taken; throws Error{too_large} naming the
    /// limit where not even one fits. After an error the next call is as good as the first.
    Picture render(const Scene& scene, std::uint32_t width, std::uint32_t height) {
        submit(scene, width, height);
        return finish();
    }

    /// The same in two halves, so that the CPU works on a frame while the GPU draws the one before:
    /// submit() queues a frame, finish() waits for the oldest one queued. No more than
    /// k_frames_in_flight may be queued at a time. A frame whose submit() throws is not queued, and one
    /// whose finish() throws is over.
    static constexpr std::uint32_t k_frames_in_flight = 2;

    void submit(const Scene& scene, std::uint32_t width, std::uint32_t height);
    Picture finish();

    /// Says what the next frame will probably show: its silhouettes are computed while the GPU draws.
    /// Does not wait. Instances and lights that were not in the frame before are left for the next frame,
    /// which is right whatever was announced.
    void announce(const Scene& scene) noexcept { instances_.announce(scene); }

    /// Records everything of a frame into `commands`: change sets, passes, the picture into `target`.
    /// The commands are outside a render pass, for the context's queue family or one that draws and
    /// computes too. The caller submits them in the order of recording, and
    ///   - records a frame only when the GPU is done with the frame recorded k_frames_in_flight before,
    ///     and one into a target of another size only when it is done with all of them;
    ///   - destroys the renderer only when the GPU is done.
    /// A frame that should be done and is not is found by the mark that each leaves (frame_marks.h), and
    /// stops the program. A mesh drawn for the first time is uploaded here, over the context's queue for
    /// copies, and waited for. One that deforms, and each new light of it, waits for all of the context's
    /// queue, which nobody else may use meanwhile. Bound pipelines, sets, push constants and dynamic state
    /// are others afterwards. Throws as render(), and Error{bad_input} for a format that is none to draw into; `commands` may
    /// then hold a part of the frame, and must not be submitted.
    FrameReport record(VkCommandBuffer commands, const Scene& scene, const PictureTarget& target);

    /// Says that frames recorded by record() and not done by now will never run: a command buffer was
    /// dropped, or the device lost. None of them may be running. The next frame sends everything whole.
    void forget_recorded() noexcept;

    /// Sets RendererOptions::scale of the frames to come. For record(), a change of it is as a change of
    /// the target's size.
    void set_scale(std::uint32_t scale) noexcept { options_.scale = scale; }

    /// Of the frame finished last.
    const FrameReport& report() const noexcept { return report_; }

    /// The camera's and the lights' silhouettes of an instance drawn last, for a caller's own shaders.
    /// Null where there is none.
    const TrackedSilhouette* silhouette(std::size_t instance,
                                        std::optional<std::size_t> light) const;

    /// With options.check_silhouettes: FrameReport::differences of all frames that are done, but for
    /// those a caller submitted whose ring slot has not been used again.
    std::uint64_t differences() const noexcept { return differences_; }

    /// What silhouettes take of options.stream_memory_bytes.
    std::uint64_t stream_bytes() const noexcept { return instances_.stream_bytes(); }
    /// What trackers have reserved of options.tracker_memory_bytes.
    std::uint64_t tracker_bytes() const noexcept { return instances_.tracker_bytes(); }
    /// The images of the passes, null before the first frame. They hold something where a scene is
    /// (drawn_rect(), scene_data.h) and nothing around that. After a frame depth() is read-only; with
    /// one sample its stencil holds the count of the last light.
    const RenderTargets* targets() const noexcept { return targets_.get(); }

private:
    // What a frame in flight owns until it is done. Frame n is frames_[n % k_frames_in_flight], has
    // that ring slot of every stream and of the marks.
    struct Frame {
        std::uint64_t number = 0;                   // n + 1; 0 when there is no frame to wait for.
        VkCommandBuffer commands = VK_NULL_HANDLE;  // This and the rest for submit() only.
        std::uint64_t timeline_value = 0;           // 0: a caller submits it.
        Buffer picture;
        VkExtent2D size{};
        std::vector<TrackedSilhouette*> silhouettes;  // Those followed.
        DeformedFrame deformed;
        std::chrono::steady_clock::time_point started;
        FrameReport report;
    };

    std::uint32_t ring_slot() const noexcept {
        return static_cast<std::uint32_t>(recorded_ % k_frames_in_flight);
    }
    void wait_for(std::uint64_t timeline_value) const;
    bool is_done(const Frame& frame) const noexcept;
    void prepare_picture(VkExtent2D size);
    void prepare_targets(VkExtent2D size);
    void prepare(const Scene& scene, const PictureTarget& target, Frame& frame);
    const ChangeStream& follow(TrackedSilhouette& silhouette, const HomogeneousPoint& point,
                               Frame& frame);
    void count_differences(std::uint32_t ring_slot);
    void plan_shadows(DrawList& list, Frame& frame);
    DrawList build_draw_list(const Scene& scene, Frame& frame);
    FrameReport record_frame(VkCommandBuffer commands, const Scene& scene,
                             const PictureTarget& target, Frame& frame);
    static DrawnArea drawn_area(const Scene& scene, const PictureTarget& target);
    void record_passes(VkCommandBuffer commands, const Scene& scene, const DrawList& list,
                       Frame& frame, const PictureTarget& target) const;
    static void add_deformed_counts(Frame& frame);
    void submit(Frame& frame);

    DeviceContext context_;
    RendererOptions options_;
    std::unique_ptr<SilhouetteService> own_service_;
    ScatterPass scatter_;
    DrawData draw_data_;
    SurfacePass surface_pass_;
    ShadowVolumePass shadow_pass_;
    LinePass line_pass_;
    InkPass ink_pass_;
    CompositePass composite_pass_;
    OwnedSemaphore timeline_;
    OwnedCommandPool command_pool_;
    std::array<Frame, k_frames_in_flight> frames_;
    FrameMarks marks_;
    ConsistencyCheck check_;
    std::uint64_t recorded_ = 0;        // Frames so far.
    std::uint64_t submitted_ = 0;       // Of these, by submit(): the timeline's last value.
    std::deque<std::uint32_t> queued_;  // Ring slots of those submitted and not finished.
    std::unique_ptr<RenderTargets> targets_;
    Image picture_;  // Where submit() draws.
    InstanceStates instances_;
    ShadowCounter shadow_counter_;
    std::uint64_t differences_ = 0;
    FrameReport report_;
};

}  // namespace rimline
