#pragma once

// The data of a mesh that line paths without slots (line_path.h) need besides GpuMesh: a plane a face, six
// indices a face, and the edges that are not regular. Rimline's own paths do not need it.

#include "engine/stream/every_edge_draw.h"
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
    /// non-manifold edge. The bits of such an edge's faces differ exactly if those of such a pair do.
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
