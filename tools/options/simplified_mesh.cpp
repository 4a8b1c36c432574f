#include "tools/options/simplified_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "silhouette/mesh/ids.h"

namespace rimline::tools {

namespace {

// Of edge collapses. They take a second for so many.
constexpr std::size_t k_most_collapsed = 1'000'000;
constexpr std::size_t k_joined_faces = 500'000;
constexpr float k_any_error = 1.0f;

std::vector<unsigned> corners_of_faces(const Mesh& mesh) {
    std::vector<unsigned> corners;
    corners.reserve(3 * std::size_t{mesh.face_count()});
    for (const Triangle& triangle : mesh.triangles())
        for (const VertexId vertex : triangle) corners.push_back(index(vertex));
    return corners;
}

void simplify(const Mesh& mesh, std::size_t faces, std::vector<unsigned>& corners,
              const LongCall& call) {
    std::vector<unsigned> kept(corners.size());
    const float* const positions = &mesh.positions()[0].x;
    if (corners.size() > 3 * k_most_collapsed) {
        const std::size_t joined = meshopt_simplifySloppy(
            kept.data(), corners.data(), corners.size(), positions, mesh.vertex_count(),
            sizeof(glm::vec3), 3 * std::max(faces, k_joined_faces), k_any_error, nullptr);
        // The grid has 1024 cells along the mesh: too few for small parts far from each other.
        if (joined >= 3 * std::max(faces, k_joined_faces) / 2) {
            kept.resize(joined);
            corners.swap(kept);
            kept.resize(corners.size());
        }
        call.checkpoint(0.3);
    }
    kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), positions,
                                 mesh.vertex_count(), sizeof(glm::vec3),
                                 std::min(3 * faces, corners.size()), k_any_error, 0, nullptr));
    corners.swap(kept);
}

// Vertices are those of the mesh. So the last corner at a vertex says what the vertex looks like.
FaceMaterials materials_of(const Mesh& mesh, std::span<const unsigned> corners) {
    const FaceMaterials& all = mesh.materials();
    FaceMaterials materials;
    if (all.empty()) return materials;
    std::vector<std::uint32_t> corner_at(mesh.vertex_count(), 0);
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
        for (std::uint32_t c = 0; c < 3; ++c)
            corner_at[index(mesh.triangles()[face][c])] = 3 * face + c;
    for (SurfaceMaterial material : all.materials) {
        material.texture = k_no_texture;
        materials.materials.push_back(material);
    }
    for (std::size_t i = 0; i < corners.size(); i += 3)
        materials.of_face.push_back(all.of_face[corner_at[corners[i]] / 3]);
    if (!all.corner_colors.empty())
        for (const unsigned vertex : corners)
            materials.corner_colors.push_back(all.corner_colors[corner_at[vertex]]);
    return materials;
}

}  // namespace

MeshSource simplified(const Mesh& mesh, std::uint32_t faces, const LongCall& call) {
    RIMLINE_CHECK(mesh.face_count() > 0 && faces <= mesh.face_count());
    call.checkpoint(0.0);
    std::vector<unsigned> corners = corners_of_faces(mesh);
    call.checkpoint(0.1);
    simplify(mesh, faces, corners, call);
    call.checkpoint(0.9);
    MeshSource source;
    source.up = mesh.up();
    source.is_up_known = mesh.is_up_known();
    source.materials = materials_of(mesh, corners);
    // Only vertices that are left, in their order.
    std::vector<unsigned> vertices = corners;
    std::ranges::sort(vertices);
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
    for (const unsigned vertex : vertices) source.positions.push_back(mesh.positions()[vertex]);
    const auto number_of = [&](unsigned vertex) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, vertex) -
                                          vertices.begin());
    };
    for (std::size_t i = 0; i < corners.size(); i += 3)
        source.triangles.push_back(
            {number_of(corners[i]), number_of(corners[i + 1]), number_of(corners[i + 2])});
    call.checkpoint(1.0);
    return source;
}

}  // namespace rimline::tools
