#pragma once

// Draws scenes: one tracker and one change stream for each pair of an instance and a silhouette point,
// the camera or a light; a frame moves the trackers, streams what changed, and records the passes.
//
//     move trackers --> streams --> surfaces, unlit --> for each light: volumes, surfaces, lit
//                                   --> lines --> composite --> picture

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/change_stream.h"
#include "engine/composite_pass.h"
#include "engine/draw_list.h"
#include "engine/gpu_mesh.h"
#include "engine/line_pass.h"
#include "engine/png.h"
#include "engine/render_targets.h"
#include "engine/scene.h"
#include "engine/shadow_volume_pass.h"
#include "engine/surface_pass.h"
#include "silhouette/hough/silhouette_tracker.h"

namespace rimline {

struct RendererOptions {
    /// Samples a pixel of the surface pass, 1, 2 or 4; no more than the device has are taken.
    std::uint32_t samples = 4;
    /// Pixels of every pass along each side of a pixel of the picture.
    std::uint32_t scale = 2;
    /// Shading is smooth across edges that bend by no more than this.
    float crease_angle_rad = 0.7f;
};

/// What a frame took.
struct FrameReport {
    std::uint32_t silhouette = 0;  ///< The camera's silhouette edges and borders drawn as lines.
    /// Sides of shadow volumes over all lights: regular silhouette edges, and any other edge once for
    /// each of its faces.
    std::uint32_t shadow_edges = 0;
    std::uint64_t bytes_streamed = 0;  ///< What went to the GPU for silhouettes and face bits.
    std::uint64_t bytes_full = 0;      ///< What sending them whole would have cost.
    /// From moving the trackers to the finished picture, by the clock. Uploading a mesh drawn for the
    /// first time is not in it; extracting the first silhouettes is.
    double frame_ms = 0.0;
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
    /// another at its address in between. Where the device cannot hold options.scale pixels along each
    /// side of a pixel, fewer are taken; throws Error{too_large} naming the limit where not even one
    /// fits. After an error the next call is as good as the first.
    Picture render(const Scene& scene, std::uint32_t width, std::uint32_t height) {
        submit(scene, width, height);
        return finish();
    }

    /// The same in two halves, so that the CPU works on a frame while the GPU draws the one before:
    /// submit() queues a frame, finish() waits for the oldest one queued. No more than
    /// k_frames_in_flight may be queued at a time.
    static constexpr std::uint32_t k_frames_in_flight = 2;
    void submit(const Scene& scene, std::uint32_t width, std::uint32_t height);
    Picture finish();

    /// Of the frame finished last.
    const FrameReport& report() const noexcept { return report_; }

    /// The camera's and the lights' tracker and stream of an instance submitted last, for tests and for
    /// a caller's own shaders. Null where there is none.
    const SilhouetteTracker* tracker(std::size_t instance, std::optional<std::size_t> light) const;
    const ChangeStream* stream(std::size_t instance, std::optional<std::size_t> light) const;

private:
    // One silhouette point of one instance.
    struct Tracked {
        SilhouetteTracker tracker;
        ChangeStream stream;
    };
    struct InstanceState {
        const HoughOctree* octree = nullptr;
        const GpuMesh* mesh = nullptr;
        std::unique_ptr<Tracked> camera;
        std::vector<std::unique_ptr<Tracked>> lights;
    };
    // What a frame in flight owns until it is finished. Frame n is frames_[n % k_frames_in_flight], has
    // that ring slot of every stream, and ends when the timeline reaches n + 1.
    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        Buffer data;
        Buffer picture;
        VkExtent2D size{};
        std::vector<const ChangeStream*> streams;  // Those with something to send.
        std::chrono::steady_clock::time_point started;
        FrameReport report;
    };

    std::uint32_t ring_slot() const noexcept {
        return static_cast<std::uint32_t>(submitted_ % k_frames_in_flight);
    }
    void wait_for(std::uint64_t frame_count) const;
    void prepare_targets(VkExtent2D size);
    void prepare_instances(const Scene& scene);
    const ChangeStream& follow(std::unique_ptr<Tracked>& tracked, const HoughOctree& octree,
                               const HomogeneousPoint& point, Frame& frame);
    DrawList build_draw_list(const Scene& scene, Frame& frame);
    void record(const Scene& scene, const DrawList& list, const Frame& frame) const;
    void submit(const Frame& frame);
    void forget_gpu_state() noexcept;
    const Tracked* find(std::size_t instance, std::optional<std::size_t> light) const;

    DeviceContext context_;
    RendererOptions options_;
    ScatterPass scatter_;
    SurfacePass surface_pass_;
    ShadowVolumePass shadow_pass_;
    LinePass line_pass_;
    CompositePass composite_pass_;
    OwnedSemaphore timeline_;
    OwnedCommandPool command_pool_;
    std::array<Frame, k_frames_in_flight> frames_;
    std::uint64_t submitted_ = 0;  // Frames so far.
    std::uint64_t finished_ = 0;
    std::unique_ptr<RenderTargets> targets_;
    std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
    std::vector<InstanceState> instances_;
    FrameReport report_;
};

}  // namespace rimline
