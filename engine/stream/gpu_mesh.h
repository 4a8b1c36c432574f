#pragma once

// What the GPU keeps of a mesh, whatever its silhouette: positions, triangles, normals for shading,
// and edge records (shaders/layout.h).

#include <optional>
#include <vector>

#include "engine/line_path.h"
#include "engine/stream/line_comparators.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/uploads.h"
#include "shaders/layout.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// No crease bends by less than this, whatever is asked for: of a smooth mesh every edge would be one.
constexpr float k_min_crease_rad = 0.17f;

/// An edge as all edges are listed: with no second face unless it is regular.
gpu::EdgeRecord edge_record(const Mesh& mesh, EdgeId edge);

/// Each face's own record of each of its edges that is not regular, as the face runs it: these cast
/// shadows one by one.
std::vector<gpu::EdgeRecord> loose_edge_records(const Mesh& mesh);

class GpuMesh {
public:
    /// Surfaces are shaded smooth across edges that bend by at most `crease_angle_rad`. Adds its data to
    /// `batch`, what `line_path` alone needs too: send it, and keep this until it is there. `mesh` is not
    /// needed afterwards.
    GpuMesh(UploadBatch& batch, const Mesh& mesh, float crease_angle_rad,
            LinePath line_path = LinePath::geometry);

    /// Bytes of buffers.
    std::uint64_t size_bytes() const noexcept;

    std::uint32_t face_count() const noexcept { return face_count_; }
    std::uint32_t border_count() const noexcept { return border_count_; }
    std::uint32_t loose_count() const noexcept { return loose_count_; }
    /// How many of the creases, which lie sharpest first, bend by at least this. O(log creases).
    std::uint32_t crease_count(float min_bend_rad) const noexcept;

    /// The mesh's center.
    const glm::vec3& middle() const noexcept { return middle_; }
    VkDeviceAddress positions() const noexcept { return positions_.address(); }
    VkDeviceAddress triangles() const noexcept { return triangles_.address(); }
    /// The same: 32-bit indices of vertices, three a face.
    VkBuffer indices() const noexcept { return triangles_.handle(); }
    std::uint32_t vertex_count() const noexcept { return vertex_count_; }
    VkDeviceAddress corner_normals() const noexcept { return corner_normals_.address(); }
    /// All edges, by edge number.
    VkDeviceAddress edges() const noexcept { return edges_.address(); }
    /// The borders among them.
    VkDeviceAddress borders() const noexcept { return edges_.address() + border_offset_bytes_; }
    /// One record for each face of each edge that is not regular: they are cast one by one.
    VkDeviceAddress loose_edges() const noexcept { return loose_edges_.address(); }
    /// With both faces where there are two, regular or not.
    VkDeviceAddress creases() const noexcept { return creases_.address(); }
    /// Nothing where the line path draws slots.
    const std::optional<LineComparatorMesh>& comparator() const noexcept { return comparator_; }

private:
    std::uint32_t vertex_count_ = 0;
    std::uint32_t face_count_ = 0;
    std::uint32_t border_count_ = 0;
    std::uint32_t loose_count_ = 0;
    std::uint64_t border_offset_bytes_ = 0;
    glm::vec3 middle_{};
    Buffer positions_;
    Buffer triangles_;
    Buffer corner_normals_;
    Buffer edges_;
    Buffer loose_edges_;
    Buffer creases_;
    std::vector<float> crease_bends_rad_;  // Falling.
    std::optional<LineComparatorMesh> comparator_;
};

}  // namespace rimline
