#pragma once

// A mesh whose vertices move every frame. Topology is uploaded once. The GPU computes positions and shading
// normals in every frame, and silhouettes from them (gpu_silhouette.h). Nothing is rebuilt on the CPU: no
// planes, no index.
//
//     rest positions --wave--> positions --normals--> corner normals
//     caller's positions --copy-->  |
//                                   +--> silhouettes, surfaces, caps, sides, lines: all read the same
//
// Corners that share a normal at rest (corner_normals.h) share one in every frame: an edge that is sharp at
// rest stays sharp, and a smooth one stays smooth, however the surface bends.

#include <cstdint>
#include <span>
#include <string>

#include "engine/deformation.h"
#include "engine/stream/gpu_mesh.h"
#include "engine/stream/gpu_silhouette.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/uploads.h"

namespace rimline {

class DeformingMesh {
public:
    /// `gpu_mesh` is the same mesh, uploaded; it must outlive this. Surfaces are shaded smooth across
    /// edges that bend by at most `crease_angle_rad` at rest. Its data is complete when the batch is done.
    /// Memory counts in `budget`, which must outlive it; null for none. Messages name `model`. Throws
    /// Error{too_large} naming the budget or the device's limit.
    DeformingMesh(UploadBatch& batch, const Mesh& mesh, const GpuMesh& gpu_mesh,
                  float crease_angle_rad, std::uint32_t ring_slots, MemoryBudget* budget = nullptr,
                  const std::string& model = "the model");

    /// Sets the deformation from now on, in the frame of `ring_slot`. The GPU must be done with the frame
    /// that used that slot last. O(1), or O(vertices) for MovedPositions, which must fulfill their contract.
    /// Throws Error{too_large} if the deformed mesh would leave the range of coordinates, and as the
    /// constructor when MovedPositions are given for the first time.
    void move(const Deformation& deformation, std::uint32_t ring_slot);

    const DeviceContext& context() const noexcept { return context_; }
    VkDeviceAddress positions() const noexcept { return positions_.address(); }
    VkDeviceAddress corner_normals() const noexcept { return corner_normals_.address(); }
    const Buffer& position_buffer() const noexcept { return positions_; }
    const Buffer& corner_normal_buffer() const noexcept { return corner_normals_; }
    /// For silhouettes of this mesh, which read its positions.
    const SilhouetteTopology& topology() const noexcept { return topology_; }
    FaceSource faces() const noexcept {
        return {.planes = 0, .positions = positions_.address(), .triangles = triangles_};
    }
    std::uint64_t size_bytes() const noexcept;

private:
    friend class DeformPass;
    DeviceContext context_;
    const Mesh* mesh_;
    std::uint32_t vertex_count_;
    std::uint32_t group_count_;
    std::uint32_t ring_slots_;
    VkDeviceAddress triangles_;
    std::string model_;
    SilhouetteTopology topology_;
    MemoryBudget::Share share_;  // Of everything but the topology and the ring.
    MemoryBudget::Share ring_share_;
    Buffer positions_;
    Buffer corner_normals_;
    Buffer group_begin_;
    Buffer group_corners_;
    Buffer job_;
    Buffer ring_;  // The caller's positions; empty until there are some.
    std::uint32_t ring_slot_ = 0;
    Deformation deformation_;
};

/// The compute pipelines. All meshes of a device share one set.
class DeformPass {
public:
    explicit DeformPass(const DeviceContext& context);

    /// Records the computation of positions and normals of all `meshes`, each with its last deformation.
    /// Waits for all earlier reads of the old ones. Shaders of every stage see the new ones afterwards.
    void record(Commands commands, std::span<const DeformingMesh* const> meshes) const;

private:
    std::uint32_t groups_a_row_;
    OwnedPipelineLayout layout_;
    OwnedPipeline wave_;
    OwnedPipeline normals_;
};

}  // namespace rimline
