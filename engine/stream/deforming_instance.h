#pragma once

// The state of an instance that deforms: its mesh, a silhouette for the camera and one for each light. A
// frame lists what the GPU computes for all such instances.
//
//     begin_frame(): the deformation    camera(), light(): the silhouette points
//            +--> DeformedFrame::record(): positions, normals, all silhouettes at once
//            +--> DeformedFrame::counts(): their sizes, when the GPU is done

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/stream/deforming_mesh.h"
#include "engine/stream/gpu_silhouette.h"
#include "engine/vulkan/functions.h"

namespace rimline {

/// The pipelines for everything that deforms on a device.
struct DeformPasses {
    explicit DeformPasses(const DeviceContext& context) : deform(context), silhouettes(context) {}
    DeformPass deform;
    GpuSilhouettePass silhouettes;
};

/// Sums over silhouettes.
struct DeformedCounts {
    std::uint64_t silhouette = 0;  ///< Edges.
    std::uint64_t regular = 0;     ///< Of them, regular ones.
    // Since the previous frame; 0 for a silhouette in its first frame.
    std::uint64_t flips = 0;
    std::uint64_t added = 0;
    std::uint64_t removed = 0;
};

/// The work of one frame in flight, and the counts that the GPU returns.
class DeformedFrame {
public:
    enum class Purpose : std::uint8_t { line, shadow };

    /// Clears it for another frame. The GPU must be done with the previous one.
    void clear() noexcept;
    void add(const DeformingMesh& mesh) { meshes_.push_back(&mesh); }
    /// `is_first`: the silhouette has not been computed before.
    void add(const SilhouetteRun& run, Purpose purpose, bool is_first);
    bool is_empty() const noexcept { return meshes_.empty(); }

    /// Records everything that was added. Throws Error{too_large} if there is no memory for counts.
    void record(const DeviceContext& context, Commands commands, const DeformPasses& passes);

    /// Sums over the runs of one purpose. The GPU must be done with the frame.
    DeformedCounts counts(Purpose purpose) const;

private:
    struct Use {
        Purpose purpose;
        bool is_first;
    };
    std::vector<const DeformingMesh*> meshes_;
    std::vector<SilhouetteRun> runs_;
    std::vector<Use> uses_;  // Of the runs.
    Buffer counts_;          // GpuSilhouetteCounts of each run.
};

class DeformingInstance {
public:
    /// As DeformingMesh.
    DeformingInstance(UploadBatch& batch, const Mesh& mesh, const GpuMesh& gpu_mesh,
                      float crease_angle_rad, std::uint32_t ring_slots, MemoryBudget& budget,
                      const std::string& model)
        : budget_(budget),
          model_(model),
          mesh_(batch, mesh, gpu_mesh, crease_angle_rad, ring_slots, &budget, model) {}

    /// Sets the deformation, and adds the mesh to `frame`. Throws as DeformingMesh::move().
    void begin_frame(const Deformation& deformation, std::uint32_t ring_slot,
                     DeformedFrame& frame) {
        mesh_.move(deformation, ring_slot);
        frame.add(mesh_);
    }

    /// Makes the silhouettes from the camera and from a light, where they are missing, over `uploads`.
    void prepare_camera(Uploads& uploads) { make(camera_, uploads); }
    void prepare_light(std::size_t light, Uploads& uploads) {
        if (lights_.size() <= light) lights_.resize(light + 1);
        make(lights_[light], uploads);
    }

    bool has_camera() const noexcept { return camera_.silhouette != nullptr; }
    bool has_light(std::size_t light) const noexcept {
        return light < lights_.size() && lights_[light].silhouette;
    }

    /// The silhouettes from the camera and from a light, which `frame` will compute. They must be prepared.
    const GpuSilhouette& camera(const HomogeneousPoint& point, DeformedFrame& frame) {
        return add(camera_, point, DeformedFrame::Purpose::line, frame);
    }
    const GpuSilhouette& light(std::size_t light, const HomogeneousPoint& point,
                               DeformedFrame& frame) {
        return add(lights_.at(light), point, DeformedFrame::Purpose::shadow, frame);
    }

    /// Removes and returns the silhouette from the last light. The caller frees it when no frame reads it
    /// any more. There must be a light.
    std::size_t light_count() const noexcept { return lights_.size(); }
    std::unique_ptr<GpuSilhouette> take_last_light() noexcept {
        std::unique_ptr<GpuSilhouette> last = std::move(lights_.back().silhouette);
        lights_.pop_back();
        return last;
    }

    /// A frame that was to compute the silhouettes did not run: the next one counts as their first.
    void invalidate() noexcept {
        camera_.was_computed = false;
        for (Found& light : lights_) light.was_computed = false;
    }

    const DeformingMesh& mesh() const noexcept { return mesh_; }

private:
    struct Found {
        std::unique_ptr<GpuSilhouette> silhouette;
        bool was_computed = false;
    };

    void make(Found& found, Uploads& uploads);
    static const GpuSilhouette& add(Found& found, const HomogeneousPoint& point,
                                    DeformedFrame::Purpose purpose, DeformedFrame& frame);

    MemoryBudget& budget_;
    std::string model_;
    DeformingMesh mesh_;
    Found camera_;
    std::vector<Found> lights_;
};

}  // namespace rimline
