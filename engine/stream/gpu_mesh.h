#pragma once

// The data of a mesh on the GPU that does not depend on a silhouette: positions, triangles, normals for
// shading, colors of faces, and edge records (shaders/layout.h).

#include <optional>
#include <vector>

#include "engine/line_path.h"
#include "engine/stream/gpu_textures.h"
#include "engine/stream/line_comparators.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/uploads.h"
#include "silhouette/mesh/material_inks.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The least bend of a crease, 10 degrees. With a smaller one every edge of a smooth mesh would be a crease.
constexpr float k_min_crease_rad = 0.17f;

/// The colors of a mesh that has some (silhouette/mesh/face_materials.h).
class GpuMaterials {
public:
    GpuMaterials(UploadBatch& batch, TextureSamplers& samplers, const FaceMaterials& materials);

    std::uint64_t size_bytes() const noexcept;
    VkDeviceAddress base_colors() const noexcept { return base_colors_.address(); }
    VkDeviceAddress of_face() const noexcept { return of_face_.address(); }
    bool has_corner_colors() const noexcept { return corner_colors_.size() > 0; }
    /// 0 without corner colors.
    VkDeviceAddress corner_colors() const noexcept { return corner_colors_.address(); }
    const MaterialInks& inks() const noexcept { return inks_; }
    /// MaterialInks::of_face.
    VkDeviceAddress face_inks() const noexcept { return face_inks_.address(); }
    /// Empty if no texture has a picture.
    const std::optional<GpuTextures>& textures() const noexcept { return textures_; }

private:
    MaterialInks inks_;
    Buffer base_colors_, of_face_, corner_colors_, face_inks_;
    std::optional<GpuTextures> textures_;
};

class GpuMesh {
public:
    /// Surfaces are shaded smooth across edges that bend by at most `crease_angle_rad`. Adds its data to
    /// `batch`, with the data that only `line_path` needs, and hull_normals() if `has_hull`. The caller sends the
    /// batch, and keeps this object until the copies are done. `samplers` must outlive it. `mesh` is not needed
    /// afterwards.
    GpuMesh(UploadBatch& batch, TextureSamplers& samplers, const Mesh& mesh, float crease_angle_rad,
            LinePath line_path = LinePath::geometry, bool has_hull = false);

    /// Bytes of buffers.
    std::uint64_t size_bytes() const noexcept;

    std::uint32_t face_count() const noexcept { return face_count_; }
    std::uint32_t border_count() const noexcept { return border_count_; }
    std::uint32_t loose_count() const noexcept { return loose_count_; }
    /// Which creases: all from k_min_crease_rad on, or those from 30 degrees on that stand out
    /// (silhouette/mesh/clear_creases.h).
    enum class Creases : std::uint8_t { all, clear };
    /// The number of creases that bend by at least this. Creases are sorted, the sharpest first.
    /// O(log creases).
    std::uint32_t crease_count(Creases which, float min_bend_rad) const noexcept;

    /// The mesh's center.
    const glm::vec3& center() const noexcept { return center_; }
    VkDeviceAddress positions() const noexcept { return positions_.address(); }
    VkDeviceAddress triangles() const noexcept { return triangles_.address(); }
    /// The same buffer: 32-bit indices of vertices, three a face.
    VkBuffer indices() const noexcept { return triangles_.handle(); }
    std::uint32_t vertex_count() const noexcept { return vertex_count_; }
    VkDeviceAddress corner_normals() const noexcept { return corner_normals_.address(); }
    /// The same, smooth across all edges: all corners of a vertex move alike. 0 if it has no hull.
    VkDeviceAddress hull_normals() const noexcept { return hull_normals_.address(); }
    /// edge_records(), by edge number.
    VkDeviceAddress edges() const noexcept { return edges_.address(); }
    /// The records of borders among them.
    VkDeviceAddress borders() const noexcept { return edges_.address() + border_offset_bytes_; }
    /// loose_edge_records().
    VkDeviceAddress loose_edges() const noexcept { return loose_edges_.address(); }
    /// With both faces if there are two, regular or not.
    VkDeviceAddress creases(Creases which) const noexcept {
        return which == Creases::all ? creases_.address() : clear_creases_.address();
    }
    /// Empty if no face has a color.
    const std::optional<GpuMaterials>& materials() const noexcept { return materials_; }
    /// Empty if the line path draws slots.
    const std::optional<LineComparatorMesh>& comparator() const noexcept { return comparator_; }

private:
    std::uint32_t vertex_count_ = 0;
    std::uint32_t face_count_ = 0;
    std::uint32_t border_count_ = 0;
    std::uint32_t loose_count_ = 0;
    std::uint64_t border_offset_bytes_ = 0;
    glm::vec3 center_{};
    Buffer positions_;
    Buffer triangles_;
    Buffer corner_normals_, hull_normals_;
    Buffer edges_;
    Buffer loose_edges_;
    Buffer creases_, clear_creases_;
    std::vector<float> crease_bends_rad_, clear_bends_rad_;  // Descending.
    std::optional<GpuMaterials> materials_;
    std::optional<LineComparatorMesh> comparator_;
};

}  // namespace rimline
