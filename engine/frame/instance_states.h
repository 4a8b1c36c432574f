#pragma once

// What a renderer keeps of a scene from one frame to the next: its meshes on the GPU, each once, and for
// each instance the silhouettes from the camera and the lights, or what deforms it. What leaves the scene
// stays until no frame can read it.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "engine/line_path.h"
#include "engine/scene.h"
#include "engine/stream/deforming_instance.h"
#include "engine/stream/gpu_mesh.h"
#include "engine/stream/tracked_silhouette.h"
#include "engine/vulkan/uploads.h"

namespace rimline {

struct InstanceState {
    const Mesh* source = nullptr;
    const HoughOctree* octree = nullptr;  ///< Null where the mesh deforms.
    const GpuMesh* mesh = nullptr;
    bool is_closed_chain = false;
    std::unique_ptr<DeformingInstance> deforming;
    std::unique_ptr<TrackedSilhouette> camera;
    std::vector<std::unique_ptr<TrackedSilhouette>> lights;
};

class InstanceStates {
public:
    struct Options {
        float crease_angle_rad;
        LinePath line_path;
        std::uint32_t ring_slots;
        std::uint64_t stream_memory_bytes;  ///< As RendererOptions has them.
        std::uint64_t tracker_memory_bytes;
    };
    /// Frames are numbered from 1 as they are recorded.
    struct Frames {
        std::uint64_t recorded;  ///< So far.
        /// The first that may still run.
        std::uint64_t first_running = std::numeric_limits<std::uint64_t>::max();
    };
    struct Uploaded {
        std::uint32_t meshes = 0;
        std::uint64_t bytes = 0;
    };

    /// The context's device and the service must outlive it, and it all frames.
    InstanceStates(const DeviceContext& context, SilhouetteService& service,
                   const Options& options);

    /// Makes room for the scene's instances and lights and sends meshes that are new on their way; what
    /// the scene has no more is retired.
    Uploaded prepare(const Scene& scene, const Frames& frames);
    /// Makes silhouettes that are missing, and sets the service to work on all points before the first is
    /// waited for. The scene is prepared.
    void prepare_silhouettes(const Scene& scene);
    /// As Renderer::announce().
    void announce(const Scene& scene) noexcept;
    /// What was queued never ran, though the trackers have moved: everything is sent whole.
    void invalidate() noexcept;

    std::vector<InstanceState>& all() noexcept { return instances_; }
    const std::vector<InstanceState>& all() const noexcept { return instances_; }
    Uploads& uploads() noexcept { return uploads_; }
    /// Only where an instance deforms.
    const DeformPasses& deform_passes() const noexcept { return *deform_passes_; }
    std::uint64_t stream_bytes() const noexcept { return stream_budget_.used_bytes(); }
    std::uint64_t tracker_bytes() const noexcept { return tracker_budget_.used_bytes(); }

private:
    // What has gone from the scene, while frames up to `last_frame` may still read it.
    struct Retired {
        std::uint64_t last_frame;
        std::unique_ptr<TrackedSilhouette> silhouette;
        std::unique_ptr<GpuMesh> mesh;
        std::unique_ptr<DeformingInstance> deforming;
        std::unique_ptr<GpuSilhouette> found;
    };

    Retired& next_retired();
    void retire(std::unique_ptr<TrackedSilhouette>& silhouette);
    void retire(InstanceState& state);
    void retire_unused_meshes();
    const GpuMesh& upload(const Mesh& mesh, Uploaded& uploaded);
    void make(InstanceState& state, const SceneInstance& instance, Uploaded& uploaded);

    DeviceContext context_;
    SilhouetteService& service_;
    Options options_;
    MemoryBudget stream_budget_;
    MemoryBudget tracker_budget_;
    std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
    std::unique_ptr<DeformPasses> deform_passes_;  // When the first instance deforms.
    std::vector<InstanceState> instances_;
    std::vector<Retired> retired_;
    std::uint64_t recorded_ = 0;  // Frames by the last prepare().
    bool unused_meshes_ = false;  // Whether meshes_ may hold one that no instance has.
    Uploads uploads_;  // After the meshes: gone before them, it waits for what is on its way.
};

}  // namespace rimline
