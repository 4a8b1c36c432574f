#pragma once

// Draws scenes: one tracker and one change stream for each pair of an instance and a silhouette point,
// the camera or a light; a frame moves the trackers, streams what changed, and records the passes.
//
//     move trackers --> streams --> surfaces, unlit --> for each light: volumes, surfaces, lit
//                                   --> lines --> composite --> picture

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
    std::uint32_t silhouette = 0;    ///< The camera's silhouette edges and borders drawn as lines.
    std::uint32_t shadow_edges = 0;  ///< Edges extruded, over all lights.
    std::uint64_t bytes_streamed = 0;  ///< What went to the GPU for silhouettes and face bits.
    std::uint64_t bytes_full = 0;      ///< What sending them whole would have cost.
    double frame_ms = 0.0;  ///< From moving the trackers to the finished picture, by the clock.
};

class Renderer {
public:
    /// `context` must outlive the renderer.
    Renderer(const DeviceContext& context, const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws `scene` as a picture of the given size, and waits for it. Trackers, streams and meshes
    /// are kept from one call to the next for instances and lights that stay at their index; a mesh
    /// must not change its address's meaning in between. Throws Error{too_large} naming the limit.
    Picture render(const Scene& scene, std::uint32_t width, std::uint32_t height);

    const FrameReport& report() const noexcept { return report_; }

    /// The camera's and the lights' tracker and stream of an instance drawn last, for tests and for a
    /// caller's own shaders. Null where there is none.
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
    // What a frame in flight owns until the GPU is done with it.
    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        Buffer data;
        std::uint64_t finished_at = 0;  // Value of the timeline.
    };
    static constexpr std::uint32_t k_frames_in_flight = 2;

    void wait_for(std::uint64_t timeline_value) const;
    void prepare_instances(const Scene& scene);
    void follow(std::unique_ptr<Tracked>& tracked, const HoughOctree& octree,
                const HomogeneousPoint& point, std::uint32_t ring_slot);
    DrawList build_draw_list(const Scene& scene, Frame& frame, std::uint32_t ring_slot);
    void record(const Scene& scene, const DrawList& list, VkCommandBuffer commands) const;
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
    std::vector<Frame> frames_;
    std::uint64_t frame_number_ = 0;
    std::unique_ptr<RenderTargets> targets_;
    std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
    std::vector<InstanceState> instances_;
    FrameReport report_;
};

}  // namespace rimline
