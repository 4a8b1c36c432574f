#include "engine/stream/gpu_mesh.h"

#include <algorithm>
#include <numbers>

#include "engine/stream/edge_records.h"
#include "silhouette/mesh/clear_creases.h"
#include "silhouette/mesh/corner_normals.h"
#include "silhouette/mesh/creases.h"

namespace rimline {

namespace {

constexpr float k_min_clear_rad = 30.0f * std::numbers::pi_v<float> / 180.0f;

static_assert(sizeof(Triangle) == sizeof(gpu::TriangleRecord));

Buffer add_base_colors(UploadBatch& batch, const FaceMaterials& materials) {
    std::vector<glm::vec3> colors;
    for (const SurfaceMaterial& material : materials.materials)
        colors.push_back(material.base_color);
    return batch.add(std::span<const glm::vec3>(colors), "base colors");
}

// Four in a word.
Buffer add_face_inks(UploadBatch& batch, std::vector<std::uint8_t> inks) {
    inks.resize((inks.size() + 3) / 4 * 4);
    return batch.add(std::span<const std::uint8_t>(inks), "inks of faces");
}

}  // namespace

GpuMaterials::GpuMaterials(UploadBatch& batch, TextureSamplers& samplers,
                           const FaceMaterials& materials)
    : inks_(material_inks(materials)),
      base_colors_(add_base_colors(batch, materials)),
      of_face_(batch.add(std::span<const MaterialId>(materials.of_face), "materials of faces")),
      face_inks_(add_face_inks(batch, inks_.of_face)) {
    if (!materials.corner_colors.empty())
        corner_colors_ =
            batch.add(std::span<const glm::vec3>(materials.corner_colors), "corner colors");
    if (materials.has_pictures()) textures_.emplace(batch, samplers, materials);
}

std::uint64_t GpuMaterials::size_bytes() const noexcept {
    return base_colors_.size() + of_face_.size() + corner_colors_.size() + face_inks_.size() +
           (textures_ ? textures_->size_bytes() : 0);
}

GpuMesh::GpuMesh(UploadBatch& batch, TextureSamplers& samplers, const Mesh& mesh,
                 float crease_angle_rad, LinePath line_path, bool has_hull)
    : vertex_count_(mesh.vertex_count()),
      face_count_(mesh.face_count()),
      border_count_(mesh.edges_of_class(EdgeClass::border).size()),
      border_offset_bytes_(sizeof(gpu::EdgeRecord) *
                           std::uint64_t{mesh.edges_of_class(EdgeClass::border).first}),
      center_(mesh.center()),
      positions_(batch.add(mesh.positions(), "positions")),
      triangles_(batch.add(mesh.triangles(), "triangles")) {
    const std::vector<glm::vec3> normals = rimline::corner_normals(mesh, crease_angle_rad);
    corner_normals_ = batch.add(std::span<const glm::vec3>(normals), "normals");
    if (has_hull) {
        const std::vector<glm::vec3> smooth =
            rimline::corner_normals(mesh, std::numbers::pi_v<float>);
        hull_normals_ = batch.add(std::span<const glm::vec3>(smooth), "normals of the hull");
    }
    const std::vector<gpu::EdgeRecord> edges = edge_records(mesh);
    edges_ = batch.add(std::span<const gpu::EdgeRecord>(edges), "edges");
    const std::vector<gpu::EdgeRecord> loose = loose_edge_records(mesh);
    loose_count_ = static_cast<std::uint32_t>(loose.size());
    loose_edges_ = batch.add(std::span<const gpu::EdgeRecord>(loose), "loose edges");
    const auto add_creases = [&](std::span<const Crease> creases, std::vector<float>& bends_rad) {
        std::vector<gpu::EdgeRecord> records;
        for (const Crease& crease : creases) {
            const Edge& edge = mesh.edge(crease.edge);
            records.push_back({index(edge.vertices[0]), index(edge.vertices[1]),
                               index(edge.faces[0]), index(edge.faces[1])});
            bends_rad.push_back(crease.bend_rad);
        }
        return batch.add(std::span<const gpu::EdgeRecord>(records), "creases");
    };
    const std::vector<Crease> creases = find_creases(mesh, k_min_crease_rad);
    creases_ = add_creases(creases, crease_bends_rad_);
    const std::span<const Crease> sharp(creases.data(),
                                        crease_count(Creases::all, k_min_clear_rad));
    clear_creases_ = add_creases(clear_creases(mesh, sharp), clear_bends_rad_);
    if (!mesh.materials().empty()) materials_.emplace(batch, samplers, mesh.materials());
    if (!draws_slots(line_path)) comparator_.emplace(batch, mesh);
}

std::uint64_t GpuMesh::size_bytes() const noexcept {
    std::uint64_t size = comparator_ ? comparator_->size_bytes() : 0;
    if (materials_) size += materials_->size_bytes();
    for (const Buffer* buffer : {&positions_, &triangles_, &corner_normals_, &hull_normals_,
                                 &edges_, &loose_edges_, &creases_, &clear_creases_})
        size += buffer->size();
    return size;
}

std::uint32_t GpuMesh::crease_count(Creases which, float min_bend_rad) const noexcept {
    const std::vector<float>& bends = which == Creases::all ? crease_bends_rad_ : clear_bends_rad_;
    const auto end = std::ranges::upper_bound(bends, min_bend_rad, std::greater<>());
    return static_cast<std::uint32_t>(end - bends.begin());
}

}  // namespace rimline
