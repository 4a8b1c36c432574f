#pragma once

// Draws scenes: one tracked silhouette for each pair of an instance and a silhouette point (the camera or
// a light). A frame moves the trackers, streams what changed, and records the passes. Trackers move on the
// threads of a SilhouetteService: in parallel within a frame, and, for a frame that was announced, while
// the GPU draws the previous one.
//
//     move trackers --> streams --> surfaces, unlit --> for each light: volumes, surfaces, lit
//                                   (or surfaces --> volumes --> surfaces, in shadow: drawing.md)
//                                   --> grid, lines, ink --> composite --> picture
//
// There are two ways to a picture. render(), or its halves submit() and finish(), submit to the queue
// and read the picture back. prepare() makes what a frame needs; record() writes the same commands into a
// caller's command buffer, draws into a caller's image, and leaves the queue to the caller.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/frame_report.h"
#include "engine/renderer_options.h"
#include "engine/scene.h"
#include "engine/silhouette_changes.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/upload_point.h"
#include "silhouette/picture.h"

namespace rimline {

struct DeviceContext;
class FramesInFlight;
class RenderTargets;

class Renderer {
public:
    /// The context's device must outlive the renderer.
    Renderer(const DeviceContext& context, const RendererOptions& options = {});
    /// Waits for the frames of submit() and for the copies of prepare(). On Mesa's CPU device (lavapipe), if there were
    /// copies, it submits to the queue, under its lock, and waits for all that the queue has to do.
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws `scene` as a picture of the given size, and waits for it. Trackers and streams are kept from
    /// one call to the next while each scene has an instance of the same octree, at whatever index, and within it for
    /// lights by index; instances of one octree are told apart by their order. Meshes are kept likewise. A mesh that
    /// deforms is kept by its address; its lines need a line path that draws slots (RendererOptions::line_path). Where
    /// the device cannot hold options.scale pixels along each side of a pixel, fewer are taken; throws
    /// Error{too_large} naming the limit where not even one fits. After an error the next call works as the first.
    Picture render(const Scene& scene, std::uint32_t width, std::uint32_t height) {
        submit(scene, width, height);
        return finish();
    }

    /// render() in two halves, so that the CPU prepares a frame while the GPU draws the previous one:
    /// submit() queues a frame, finish() waits for the oldest one queued. At most
    /// RendererOptions::frames_in_flight may be queued at a time. A frame whose submit() throws is not
    /// queued, and one whose finish() throws is over.
    void submit(const Scene& scene, std::uint32_t width, std::uint32_t height);
    Picture finish();

    /// Announces what the next frame will probably show: its silhouettes are computed while the GPU draws.
    /// Does not wait. Instances and lights that were not in the previous frame are ignored. The next frame
    /// is correct whatever was announced.
    void announce(const Scene& scene) noexcept;

    /// Makes what record() needs for `scene` and `target`, of which format, extent, use, and whether there is a
    /// backdrop count: meshes and silhouettes on the GPU, the images and pipelines of the passes. Call it when a scene
    /// has other instances, lights, lines, surfaces, shadows or another style, or when the target or the scale changes;
    /// where nothing is missing it costs O(instances * lights), so also before every frame. Only the scene prepared
    /// last can be recorded: what it does not need is freed when no frame uses it any more.
    ///
    /// Copies of new meshes are submitted to the context's queue for copies, under its lock. They are not
    /// waited for, but where more than UploadBatch::k_max_staged_bytes (uploads.h) are copied. The next
    /// submission of a recorded frame must wait for the point returned; later ones may too. For a target of
    /// another size or scale, for the first layer (PictureUse), and where the default scale is not 1, as on CPU
    /// devices, for a backdrop that comes or goes, the GPU must be done with all recorded frames. Throws as render(),
    /// and Error{bad_input} where it is not done, for a target that cannot be drawn into, and for a backdrop that
    /// cannot be read.
    [[nodiscard]] UploadPoint prepare(const Scene& scene, const PictureTarget& target);

    /// Records everything of a frame into `commands`: change sets, passes, the picture into `target`. Never
    /// submits, waits for the GPU or makes a pipeline: everything must be prepared.
    /// The commands are outside a render pass, for the context's queue family. The caller submits them in the order of
    /// recording, and
    ///   - records a frame only when the GPU is done with the frame recorded
    ///     RendererOptions::frames_in_flight before;
    ///   - destroys the renderer only when the GPU is done.
    /// Each frame leaves a mark (frame_marks.h); a frame that is not done when it should be stops the
    /// program, as one that is not prepared does, a null handle, and a backdrop whose format has no depth.
    /// Changes the bound pipeline, descriptor sets, push constants
    /// and dynamic state. Throws as render(); `commands` may then hold a part of the frame, and must not be
    /// submitted.
    FrameReport record(VkCommandBuffer commands, const Scene& scene, const PictureTarget& target);
    /// The same in two parts, for a target that is not free at once, as a swapchain's: only `picture` uses it.
    /// Submit it after `commands`, to the same queue; wait for the target there.
    FrameReport record(VkCommandBuffer commands, VkCommandBuffer picture, const Scene& scene,
                       const PictureTarget& target);

    /// Declares that frames recorded by record() and not done by now will never run, because a command
    /// buffer was dropped or the device lost. None of them may be running. The next frame sends the whole
    /// state of all silhouettes.
    void forget_recorded() noexcept;

    /// Sets RendererOptions::scale of the following frames; 0: the device's default. For prepare(), a change
    /// of the scale counts as a change of the target's size.
    void set_scale(std::uint32_t scale) noexcept;

    /// The report of the frame finished last.
    const FrameReport& report() const noexcept;

    /// The silhouette of an instance from a light, or from the camera where no light is given. Nothing where
    /// the frame recorded last has none: it needed none, or the scene had no such instance or light. O(log
    /// silhouettes).
    std::optional<SilhouetteBuffers> silhouette(std::size_t instance,
                                                std::optional<std::size_t> light) const;

    /// With options.check_silhouettes: the sum of FrameReport::differences over all frames that are done.
    /// A frame that a caller submitted is included once its ring slot has been used again.
    std::uint64_t differences() const noexcept;

    /// Bytes of options.stream_memory_bytes in use.
    std::uint64_t stream_bytes() const noexcept;
    /// Bytes of options.tracker_memory_bytes in use.
    std::uint64_t tracker_bytes() const noexcept;
    /// The images of the passes (render_targets.h); null before the first frame. Their content is
    /// defined only within the rectangle around the scene (drawn_rect(), drawn_rect.h). After a
    /// frame depth() is read-only; with one sample and RendererOptions::keeps_stencil its stencil holds the
    /// count of the last light.
    const RenderTargets* targets() const noexcept;

private:
    std::unique_ptr<FramesInFlight> frames_;
};

}  // namespace rimline
