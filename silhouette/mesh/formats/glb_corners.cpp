#include "silhouette/mesh/formats/glb_corners.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "silhouette/mesh/formats/embed_textures.h"

namespace rimline {

namespace {

// The color and the coordinates of a corner.
using Look = std::array<float, 5>;

constexpr Look k_plain{1.0f, 1.0f, 1.0f, 0.0f, 0.0f};

}  // namespace

bool has_embedded_texture(const FaceMaterials& materials, MaterialId material) noexcept {
    if (material == k_no_material || materials.corner_uvs.empty()) return false;
    const TextureId texture = materials.materials[index(material)].texture;
    if (texture == k_no_texture) return false;
    const auto& bytes = materials.textures[index(texture)].embedded;
    return bytes && picture_mime_type(*bytes);
}

GlbCorners glb_corners(const Mesh& mesh) {
    const FaceMaterials& materials = mesh.materials();
    const bool have_colors = !materials.corner_colors.empty();
    const bool have_uvs = std::ranges::any_of(materials.of_face, [&](MaterialId material) {
        return has_embedded_texture(materials, material);
    });
    GlbCorners made;
    if (!have_colors && !have_uvs) return made;
    const auto vertex_at = [&](std::uint32_t corner) {
        return mesh.triangles()[corner / 3][corner % 3];
    };
    const auto look_of = [&](std::uint32_t corner) {
        Look look = k_plain;
        if (have_colors)
            for (int c = 0; c < 3; ++c)
                look[static_cast<std::size_t>(c)] = materials.corner_colors[corner][c];
        if (have_uvs && has_embedded_texture(materials, materials.of_face[corner / 3])) {
            look[3] = materials.corner_uvs[corner].x;
            look[4] = materials.corner_uvs[corner].y;
        }
        return look;
    };
    std::vector<Look> looks(mesh.vertex_count(), k_plain);
    std::vector<bool> has_look(mesh.vertex_count(), false);
    std::vector<std::uint32_t> others;  // Corners whose look is not that of their vertex.
    for (std::uint32_t corner = 0; corner < 3 * mesh.face_count(); ++corner) {
        if (materials.of_face[corner / 3] == k_no_material) continue;
        const std::uint32_t v = index(vertex_at(corner));
        const Look look = look_of(corner);
        if (!has_look[v]) {
            looks[v] = look;
            has_look[v] = true;
        } else if (looks[v] != look) {
            others.push_back(corner);
        }
    }
    if (!others.empty()) {
        // Equal looks of a vertex lie together. Corners are the last key, so the order is one.
        const auto place = [&](std::uint32_t corner) {
            return std::tuple(index(vertex_at(corner)), look_of(corner));
        };
        std::ranges::sort(others, [&](std::uint32_t a, std::uint32_t b) {
            return std::tuple(place(a), a) < std::tuple(place(b), b);
        });
        made.vertices.reserve(std::size_t{3} * mesh.face_count());
        for (const Triangle& triangle : mesh.triangles())
            for (const VertexId v : triangle) made.vertices.push_back(index(v));
        for (std::size_t i = 0; i < others.size(); ++i) {
            if (i == 0 || place(others[i]) != place(others[i - 1])) {
                made.copies.push_back(vertex_at(others[i]));
                looks.push_back(look_of(others[i]));
            }
            made.vertices[others[i]] = static_cast<std::uint32_t>(looks.size() - 1);
        }
    }
    for (const Look& look : looks) {
        if (have_colors) made.colors.emplace_back(look[0], look[1], look[2]);
        if (have_uvs) made.uvs.emplace_back(look[3], look[4]);
    }
    return made;
}

}  // namespace rimline
