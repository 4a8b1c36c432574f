#include "silhouette/mesh/brute_force.h"

namespace rimline {

std::vector<std::uint32_t> brute_force_face_bits(const Mesh& mesh, const HomogeneousPoint& point) {
    std::vector<std::uint32_t> words(face_word_count(mesh.face_count()), 0);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        if (is_front(mesh.plane(FaceId{f}), point)) words[f / 32] |= 1u << (f % 32);
    return words;
}

std::vector<EdgeId> brute_force_silhouette(const Mesh& mesh, const HomogeneousPoint& point) {
    const std::vector<std::uint32_t> words = brute_force_face_bits(mesh, point);
    std::vector<EdgeId> edges;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        if (is_on_silhouette(mesh, EdgeId{e}, words)) edges.push_back(EdgeId{e});
    return edges;
}

}  // namespace rimline
