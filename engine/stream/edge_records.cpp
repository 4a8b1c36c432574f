#include "engine/stream/edge_records.h"

namespace rimline {

gpu::EdgeRecord edge_record(const Mesh& mesh, EdgeId id) {
    const Edge& edge = mesh.edge(id);
    const bool regular = mesh.edge_class(id) == EdgeClass::regular;
    return {index(edge.vertices[0]), index(edge.vertices[1]), index(edge.faces[0]),
            index(regular ? edge.faces[1] : k_no_face)};
}

std::vector<gpu::EdgeRecord> edge_records(const Mesh& mesh) {
    std::vector<gpu::EdgeRecord> records;
    records.reserve(mesh.edge_count());
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        records.push_back(edge_record(mesh, EdgeId{e}));
    return records;
}

std::vector<gpu::EdgeRecord> loose_edge_records(const Mesh& mesh) {
    std::vector<gpu::EdgeRecord> records;
    for (std::uint32_t e = mesh.edges_of_class(EdgeClass::regular).last; e < mesh.edge_count(); ++e)
        for (const FaceId face : mesh.faces_of(EdgeId{e})) {
            const Triangle& triangle = mesh.triangles()[index(face)];
            for (std::size_t corner = 0; corner < 3; ++corner)
                if (mesh.edges_of(face)[corner] == EdgeId{e})
                    records.push_back({index(triangle[corner]), index(triangle[(corner + 1) % 3]),
                                       index(face), index(k_no_face)});
        }
    return records;
}

}  // namespace rimline
