#pragma once

// A mesh whose vertices move every frame. Topology is uploaded once; positions and the normals to shade
// with are made anew on the GPU, and silhouettes from them (gpu_silhouette.h). Nothing is rebuilt on the
// CPU: no planes, no index.
//
//     rest positions --wave--> positions --normals--> corner normals
//     caller's positions --copy-->  |
//                                   +--> silhouettes, surfaces, caps, sides, lines: all read the same
//
// Normals keep the groups of corners that share one at rest (corner_normals.h): what is an edge to the
// eye at rest stays one, and what is smooth stays smooth, however the surface bends later.

#include <cstdint>
#include <span>
#include <string>

#include "engine/deformation.h"
#include "engine/stream/gpu_mesh.h"
#include "engine/stream/gpu_silhouette.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class DeformingMesh {
public:
    /// `gpu_mesh` is the same mesh, uploaded; it must outlive this. Surfaces are shaded smooth across
    /// edges that bend by at most `crease_angle_rad` at rest. Uploads and waits. Memory is of `budget`,
    /// which must outlive it; null for none. Messages name `model`. Throws Error{too_large} naming the
    /// budget or the device's limit.
    DeformingMesh(const DeviceContext& context, const Mesh& mesh, const GpuMesh& gpu_mesh,
                  float crease_angle_rad, std::uint32_t ring_slots, MemoryBudget* budget = nullptr,
                  const std::string& model = "the model");

    /// Where the mesh is from now on, for the frame of `ring_slot`: the caller has waited until the GPU is
    /// done with the frame that used that slot last. O(1), or O(vertices) for positions of the caller's.
    /// Throws Error{too_large} where the deformed mesh would leave the range of coordinates, and as the
    /// constructor where positions of the caller's come for the first time; they must be as
    /// MovedPositions says.
    void move(const Deformation& deformation, std::uint32_t ring_slot);

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
    MemoryBudget::Share share_;  // Of all but the topology and the ring.
    MemoryBudget::Share ring_share_;
    Buffer positions_;
    Buffer corner_normals_;
    Buffer group_begin_;
    Buffer group_corners_;
    Buffer job_;
    Buffer ring_;  // Positions of the caller's; empty until there are some.
    std::uint32_t ring_slot_ = 0;
    Deformation deformation_;
};

/// The compute pipelines; one set serves every mesh of a device.
class DeformPass {
public:
    explicit DeformPass(const DeviceContext& context);

    /// Records the positions and normals of all `meshes`, each as it was moved last. What read the old ones
    /// is waited for; shaders of every stage see the new ones afterwards.
    void record(VkCommandBuffer commands, std::span<const DeformingMesh* const> meshes) const;

private:
    void dispatch(VkCommandBuffer commands, std::uint32_t count) const;

    std::uint32_t groups_a_row_;
    OwnedPipelineLayout layout_;
    OwnedPipeline wave_;
    OwnedPipeline normals_;
};

}  // namespace rimline
