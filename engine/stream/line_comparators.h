#pragma once

// What the line paths without slots (line_path.h) keep of a mesh beside GpuMesh: a plane a face, six
// indices a face, and the edges that are not regular. Rimline's own paths need none of it.

#include "engine/frame/draw_list.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/uploads.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class LineComparatorMesh {
public:
    /// Adds its data to `batch`, as GpuMesh.
    LineComparatorMesh(UploadBatch& batch, const Mesh& mesh);

    /// Bytes of buffers.
    std::uint64_t size_bytes() const noexcept {
        return planes_.size() + irregular_pairs_.size() + adjacency_.size();
    }

    VkDeviceAddress planes() const noexcept { return planes_.address(); }
    /// gpu::FacePairRecord: one for an inconsistent edge, and one for each two consecutive faces of a
    /// non-manifold edge, whose bits are not all equal when those of two consecutive faces are not.
    VkDeviceAddress irregular_pairs() const noexcept { return irregular_pairs_.address(); }
    EveryEdgeDraw draw() const noexcept;

private:
    std::uint32_t regular_edge_count_;
    std::uint32_t irregular_pair_count_;
    std::uint32_t adjacency_index_count_;
    Buffer planes_;
    Buffer irregular_pairs_;
    Buffer adjacency_;
};

}  // namespace rimline
