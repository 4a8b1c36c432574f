#pragma once

// What the GPU keeps of a mesh, whatever its silhouette: positions, triangles, normals for shading,
// and edge records (shaders/layout.h).

#include "engine/memory.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class GpuMesh {
public:
    /// Surfaces are shaded smooth across edges that bend by at most `crease_angle_rad`. Uploads and
    /// waits. `mesh` is not needed afterwards.
    GpuMesh(const DeviceContext& context, const Mesh& mesh, float crease_angle_rad);

    std::uint32_t face_count() const noexcept { return face_count_; }
    std::uint32_t border_count() const noexcept { return border_count_; }
    std::uint32_t loose_count() const noexcept { return loose_count_; }

    VkDeviceAddress positions() const noexcept { return positions_.address(); }
    VkDeviceAddress triangles() const noexcept { return triangles_.address(); }
    VkDeviceAddress corner_normals() const noexcept { return corner_normals_.address(); }
    /// All edges, by edge number.
    VkDeviceAddress edges() const noexcept { return edges_.address(); }
    /// The borders among them.
    VkDeviceAddress borders() const noexcept { return edges_.address() + border_offset_bytes_; }
    /// One record for each face of each edge that is not regular: they are cast one by one.
    VkDeviceAddress loose_edges() const noexcept { return loose_edges_.address(); }

private:
    std::uint32_t face_count_ = 0;
    std::uint32_t border_count_ = 0;
    std::uint32_t loose_count_ = 0;
    std::uint64_t border_offset_bytes_ = 0;
    Buffer positions_;
    Buffer triangles_;
    Buffer corner_normals_;
    Buffer edges_;
    Buffer loose_edges_;
};

}  // namespace rimline
