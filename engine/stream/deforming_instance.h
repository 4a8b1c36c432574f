#pragma once

// An instance that deforms, as the renderer keeps it: its mesh, a silhouette for the camera and one for
// each light, and what a frame has the GPU find of them.
//
//     begin_frame(): where the mesh is    camera(), light(): from where to look
//            +--> DeformedFrame::record(): positions, normals, all silhouettes at once
//            +--> DeformedFrame::counts(): how large they were, when the GPU is done

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/stream/deforming_mesh.h"
#include "engine/stream/gpu_silhouette.h"

namespace rimline {

/// The pipelines of all that deforms on a device.
struct DeformPasses {
    explicit DeformPasses(const DeviceContext& context) : deform(context), silhouettes(context) {}
    DeformPass deform;
    GpuSilhouettePass silhouettes;
};

/// Sums over silhouettes.
struct DeformedCounts {
    std::uint64_t silhouette = 0;  ///< Edges.
    std::uint64_t regular = 0;     ///< Of them, regular ones.
    // Since the frame before; nothing for a silhouette in its first frame.
    std::uint64_t flips = 0;
    std::uint64_t added = 0;
    std::uint64_t removed = 0;
};

/// What one frame in flight has the GPU find, and the counts that come back.
class DeformedFrame {
public:
    enum class Purpose : std::uint8_t { line, shadow };

    /// Empties it for another frame; the GPU must be done with the one before.
    void clear() noexcept;
    void add(const DeformingMesh& mesh) { meshes_.push_back(&mesh); }
    /// `is_first`: the silhouette has not run before.
    void add(const SilhouetteRun& run, Purpose purpose, bool is_first);
    bool is_empty() const noexcept { return meshes_.empty(); }

    /// Records everything that was added. Throws Error{too_large} where there is no memory for counts.
    void record(const DeviceContext& context, VkCommandBuffer commands, const DeformPasses& passes);

    /// When the GPU is done with the frame.
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
    DeformingInstance(const DeviceContext& context, const Mesh& mesh, const GpuMesh& gpu_mesh,
                      float crease_angle_rad, std::uint32_t ring_slots, MemoryBudget& budget,
                      const std::string& model)
        : context_(context),
          budget_(budget),
          model_(model),
          mesh_(context, mesh, gpu_mesh, crease_angle_rad, ring_slots, &budget, model) {}

    /// Moves the mesh, and adds it to `frame`. Throws as DeformingMesh::move().
    void begin_frame(const Deformation& deformation, std::uint32_t ring_slot,
                     DeformedFrame& frame) {
        mesh_.move(deformation, ring_slot);
        frame.add(mesh_);
    }

    /// The silhouettes from the camera and from a light, which `frame` will find. Made when asked for
    /// the first time.
    const GpuSilhouette& camera(const HomogeneousPoint& point, DeformedFrame& frame) {
        return add(camera_, point, DeformedFrame::Purpose::line, frame);
    }
    const GpuSilhouette& light(std::size_t light, const HomogeneousPoint& point,
                               DeformedFrame& frame) {
        if (lights_.size() <= light) lights_.resize(light + 1);
        return add(lights_[light], point, DeformedFrame::Purpose::shadow, frame);
    }

    /// Gives up the silhouette from the last of its lights; for who frees it when no frame reads it any
    /// more.
    std::size_t light_count() const noexcept { return lights_.size(); }
    std::unique_ptr<GpuSilhouette> take_last_light() noexcept {
        std::unique_ptr<GpuSilhouette> last = std::move(lights_.back());
        lights_.pop_back();
        return last;
    }

    const DeformingMesh& mesh() const noexcept { return mesh_; }

private:
    const GpuSilhouette& add(std::unique_ptr<GpuSilhouette>& silhouette,
                             const HomogeneousPoint& point, DeformedFrame::Purpose purpose,
                             DeformedFrame& frame);

    DeviceContext context_;
    MemoryBudget& budget_;
    std::string model_;
    DeformingMesh mesh_;
    std::unique_ptr<GpuSilhouette> camera_;
    std::vector<std::unique_ptr<GpuSilhouette>> lights_;
};

}  // namespace rimline
