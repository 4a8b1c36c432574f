#include "engine/stream/gpu_mesh.h"

#include <algorithm>

#include "engine/stream/edge_records.h"
#include "silhouette/mesh/corner_normals.h"
#include "silhouette/mesh/creases.h"

namespace rimline {

namespace {

static_assert(sizeof(Triangle) == sizeof(gpu::TriangleRecord));

}  // namespace

GpuMesh::GpuMesh(UploadBatch& batch, const Mesh& mesh, float crease_angle_rad, LinePath line_path)
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
    const std::vector<gpu::EdgeRecord> edges = edge_records(mesh);
    edges_ = batch.add(std::span<const gpu::EdgeRecord>(edges), "edges");
    const std::vector<gpu::EdgeRecord> loose = loose_edge_records(mesh);
    loose_count_ = static_cast<std::uint32_t>(loose.size());
    loose_edges_ = batch.add(std::span<const gpu::EdgeRecord>(loose), "loose edges");
    std::vector<gpu::EdgeRecord> creases;
    for (const Crease& crease : find_creases(mesh, k_min_crease_rad)) {
        const Edge& edge = mesh.edge(crease.edge);
        creases.push_back({index(edge.vertices[0]), index(edge.vertices[1]), index(edge.faces[0]),
                           index(edge.faces[1])});
        crease_bends_rad_.push_back(crease.bend_rad);
    }
    creases_ = batch.add(std::span<const gpu::EdgeRecord>(creases), "creases");
    if (!draws_slots(line_path)) comparator_.emplace(batch, mesh);
}

std::uint64_t GpuMesh::size_bytes() const noexcept {
    std::uint64_t size = comparator_ ? comparator_->size_bytes() : 0;
    for (const Buffer* buffer :
         {&positions_, &triangles_, &corner_normals_, &edges_, &loose_edges_, &creases_})
        size += buffer->size();
    return size;
}

std::uint32_t GpuMesh::crease_count(float min_bend_rad) const noexcept {
    const auto end = std::ranges::upper_bound(crease_bends_rad_, min_bend_rad, std::greater<>());
    return static_cast<std::uint32_t>(end - crease_bends_rad_.begin());
}

}  // namespace rimline
