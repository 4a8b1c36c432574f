#pragma once

// The state a renderer keeps of a scene between frames: its meshes on the GPU, each once, and for each
// instance the silhouettes from the camera and the lights, or its deforming mesh. Trackers of what has left the
// scene are freed at once, and the rest of its state when no frame can read it any more.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/frame/caster_mesh.h"
#include "engine/frame/counted_volume.h"
#include "engine/frame/frame_view.h"
#include "engine/frame/moved_caster.h"
#include "engine/frame/near_count.h"
#include "engine/line_path.h"
#include "engine/renderer_options.h"
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
    CasterMesh* caster = nullptr;  ///< Null where the mesh deforms.
    bool is_closed_chain = false;
    std::unique_ptr<DeformingInstance> deforming;
    std::unique_ptr<MovedCaster> moved;  ///< Of a mesh that deforms, with has_deep_shadows.
    std::unique_ptr<TrackedSilhouette> camera;
    std::vector<std::unique_ptr<TrackedSilhouette>> lights;
    std::vector<VolumeCount> volumes;        ///< Of each light.
    std::vector<NearCounter> near_counters;  ///< The same.
};

class InstanceStates {
public:
    struct Options {
        float crease_angle_rad;
        LinePath line_path;
        OutlineMethod outline;
        std::uint32_t ring_slots;
        std::uint64_t stream_memory_bytes;   ///< As in RendererOptions.
        std::uint64_t tracker_memory_bytes;  ///< As in RendererOptions.
    };
    /// Frames are numbered from 1 as they are recorded.
    struct Frames {
        std::uint64_t recorded;  ///< The number of the last one recorded.
        /// The number of the first one that may still run.
        std::uint64_t first_running = std::numeric_limits<std::uint64_t>::max();
    };
    struct Uploaded {
        std::uint32_t meshes = 0;
        std::uint64_t bytes = 0;
    };

    /// The context's device and the service must outlive this object, and this object all frames.
    InstanceStates(const DeviceContext& context, SilhouetteService& service,
                   const Options& options);

    /// Adds the state of new instances and lights, begins to upload new meshes, and retires the state of
    /// what the scene no longer has: meshes and octrees that it has no more are not read again. Throws
    /// Error{too_large} where memory or a budget does not suffice.
    /// Adds what it uploads to `uploaded`.
    void prepare(const Scene& scene, const Frames& frames, Uploaded& uploaded);
    /// Makes missing silhouettes, and announces all points to the service before the first is waited for.
    /// `view` is of the scene prepared last.
    void prepare_silhouettes(const FrameView& view);
    /// Whether the two would make nothing: for a scene, and for the view of one for which the first holds.
    bool is_prepared(const Scene& scene) const;
    bool has_silhouettes(const FrameView& view) const;
    /// As Renderer::announce().
    void announce(const Scene& scene) noexcept;
    /// Call when queued changes never ran although the trackers have moved: the next frame sends the whole
    /// state.
    void invalidate() noexcept;

    std::vector<InstanceState>& all() noexcept { return instances_; }
    const std::vector<InstanceState>& all() const noexcept { return instances_; }
    /// Of all meshes of the scene prepared last that do not deform.
    const CasterMeshes& casters() const noexcept { return casters_; }
    Uploads& uploads() noexcept { return uploads_; }
    /// Exists only if an instance deforms.
    const DeformPasses& deform_passes() const noexcept { return *deform_passes_; }
    std::uint64_t stream_bytes() const noexcept { return stream_budget_.used_bytes(); }
    std::uint64_t tracker_bytes() const noexcept { return tracker_budget_.used_bytes(); }

private:
    // State that has left the scene; frames up to `last_frame` may still read it.
    struct Retired {
        std::uint64_t last_frame;
        std::optional<ChangeStream> stream;
        std::unique_ptr<GpuMesh> mesh;
        std::unique_ptr<DeformingInstance> deforming;
        std::unique_ptr<GpuSilhouette> gpu_silhouette;
    };

    // Whether lines are drawn from silhouettes of the camera.
    bool follows_camera() const noexcept {
        return options_.outline == OutlineMethod::lines && draws_slots(options_.line_path);
    }
    Retired& next_retired();
    void retire(std::unique_ptr<TrackedSilhouette>& silhouette);
    void retire(InstanceState& state);
    void retire_unused_meshes(const Scene& scene);
    void free_retired(const Frames& frames);
    void place(const Scene& scene);
    // Whether each instance of the scene has its state at its index.
    bool has_instances(const Scene& scene) const;
    const GpuMesh& upload(const Mesh& mesh, Uploaded& uploaded);
    void make(InstanceState& state, const SceneInstance& instance, Uploaded& uploaded);

    DeviceContext context_;
    SilhouetteService& service_;
    Options options_;
    MemoryBudget stream_budget_;
    MemoryBudget tracker_budget_;
    TextureSamplers samplers_;  // Of the meshes.
    std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
    std::vector<const HoughOctree*> kept_;  // Scene::kept of the scene prepared last.
    CasterMeshes casters_;
    std::unique_ptr<DeformPasses> deform_passes_;  // Made for the first instance that deforms.
    std::vector<InstanceState> instances_;
    std::vector<Retired> retired_;
    std::uint64_t recorded_ = 0;  // Frames::recorded of the last prepare().
    Uploads uploads_;  // Declared after the meshes: its destructor waits for their uploads.
};

}  // namespace rimline
