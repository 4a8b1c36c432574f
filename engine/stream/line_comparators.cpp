#include "engine/stream/line_comparators.h"

#include <array>
#include <vector>

#include "engine/stream/edge_records.h"
#include "shaders/layout.h"

namespace rimline {

namespace {

std::vector<gpu::FacePairRecord> irregular_pairs(const Mesh& mesh) {
    std::vector<gpu::FacePairRecord> pairs;
    const auto add_class = [&](EdgeClass edge_class, std::uint32_t drawn_if_equal) {
        const Mesh::EdgeRange range = mesh.edges_of_class(edge_class);
        for (std::uint32_t e = range.first; e < range.last; ++e) {
            const std::span<const FaceId> faces = mesh.faces_of(EdgeId{e});
            for (std::size_t i = 0; i + 1 < faces.size(); ++i)
                pairs.push_back({edge_record(mesh, EdgeId{e}), index(faces[i]), index(faces[i + 1]),
                                 drawn_if_equal});
        }
    };
    add_class(EdgeClass::inconsistent, 1);
    add_class(EdgeClass::nonmanifold, 0);
    return pairs;
}

// Vulkan's order for triangles with adjacency: each corner is followed by the neighbor's corner across the
// edge that begins there, or by itself if the edge is not regular.
std::vector<std::uint32_t> adjacency_indices(const Mesh& mesh) {
    const auto corner_across = [&](FaceId face, const Edge& edge) {
        for (const VertexId corner : mesh.triangles()[index(face)])
            if (corner != edge.vertices[0] && corner != edge.vertices[1]) return corner;
        return edge.vertices[0];
    };
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{6} * mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& triangle = mesh.triangles()[f];
        const std::array<EdgeId, 3>& edges = mesh.edges_of(FaceId{f});
        if (edges[0] == k_no_edge) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            VertexId across = triangle[corner];
            if (mesh.edge_class(edges[corner]) == EdgeClass::regular) {
                const Edge& edge = mesh.edge(edges[corner]);
                across = corner_across(edge.faces[edge.faces[0] == FaceId{f} ? 1 : 0], edge);
            }
            indices.push_back(index(triangle[corner]));
            indices.push_back(index(across));
        }
    }
    return indices;
}

}  // namespace

LineComparatorMesh::LineComparatorMesh(UploadBatch& batch, const Mesh& mesh)
    : regular_edge_count_(mesh.edges_of_class(EdgeClass::regular).size()),
      planes_(batch.add(mesh.planes(), "planes")) {
    const std::vector<gpu::FacePairRecord> pairs = rimline::irregular_pairs(mesh);
    irregular_pair_count_ = static_cast<std::uint32_t>(pairs.size());
    irregular_pairs_ = batch.add(std::span<const gpu::FacePairRecord>(pairs), "irregular edges");
    const std::vector<std::uint32_t> indices = adjacency_indices(mesh);
    adjacency_index_count_ = static_cast<std::uint32_t>(indices.size());
    adjacency_ = batch.add(std::span<const std::uint32_t>(indices), "adjacency");
}

EveryEdgeDraw LineComparatorMesh::draw() const noexcept {
    return {.regular_edge_count = regular_edge_count_,
            .irregular_pair_count = irregular_pair_count_,
            .adjacency_index_count = adjacency_index_count_,
            .adjacency = adjacency_.handle()};
}

}  // namespace rimline
