#include "silhouette/mesh/formats/glb_corners.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace rimline {

GlbCorners glb_corners(const Mesh& mesh) {
    const FaceMaterials& materials = mesh.materials();
    GlbCorners made;
    if (materials.corner_colors.empty()) return made;
    const auto vertex_at = [&](std::size_t corner) {
        return mesh.triangles()[corner / 3][corner % 3];
    };
    made.colors.assign(mesh.vertex_count(), glm::vec3(1.0f));
    std::vector<bool> has_color(mesh.vertex_count(), false);
    std::vector<std::uint32_t> others;  // Corners whose color is not that of their vertex.
    for (std::uint32_t corner = 0; corner < 3 * mesh.face_count(); ++corner) {
        if (materials.of_face[corner / 3] == k_no_material) continue;
        const std::uint32_t v = index(vertex_at(corner));
        const glm::vec3& color = materials.corner_colors[corner];
        if (!has_color[v]) {
            made.colors[v] = color;
            has_color[v] = true;
        } else if (made.colors[v] != color) {
            others.push_back(corner);
        }
    }
    if (others.empty()) return made;

    // Equal colors of a vertex lie together. Corners are the last key, so the order is one.
    const auto look = [&](std::uint32_t corner) {
        const glm::vec3& color = materials.corner_colors[corner];
        return std::tuple(index(vertex_at(corner)), color.x, color.y, color.z);
    };
    std::ranges::sort(others, [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple_cat(look(a), std::tuple(a)) < std::tuple_cat(look(b), std::tuple(b));
    });
    made.vertices.reserve(std::size_t{3} * mesh.face_count());
    for (const Triangle& triangle : mesh.triangles())
        for (const VertexId v : triangle) made.vertices.push_back(index(v));
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (i == 0 || look(others[i]) != look(others[i - 1])) {
            made.copies.push_back(vertex_at(others[i]));
            made.colors.push_back(materials.corner_colors[others[i]]);
        }
        made.vertices[others[i]] = static_cast<std::uint32_t>(made.colors.size() - 1);
    }
    return made;
}

}  // namespace rimline
