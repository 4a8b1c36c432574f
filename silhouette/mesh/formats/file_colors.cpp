#include "silhouette/mesh/formats/file_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/printable_text.h"

namespace rimline {

glm::vec3 clamped_color(const glm::vec3& color) noexcept {
    const auto clamped = [](float c) { return c > 0.0f ? (c < 1.0f ? c : 1.0f) : 0.0f; };
    return {clamped(color.x), clamped(color.y), clamped(color.z)};
}

float color_number_scale(float largest) noexcept { return largest >= 2.0f ? 1.0f / 255.0f : 1.0f; }

glm::vec2 finite_uv(const glm::vec2& uv) noexcept {
    return {std::isfinite(uv.x) ? uv.x : 0.0f, std::isfinite(uv.y) ? uv.y : 0.0f};
}

MaterialId add_white_material(FaceMaterials& materials) {
    materials.materials.emplace_back();
    return MaterialId{static_cast<std::uint32_t>(materials.materials.size() - 1)};
}

void whiten_triangles(MeshSource& source) {
    FaceMaterials& materials = source.materials;
    materials.of_face.resize(source.triangles.size(), k_no_material);
    const MaterialId white = add_white_material(materials);
    std::ranges::replace(materials.of_face, k_no_material, white);
}

void color_corners(MeshSource& source, std::span<const glm::vec3> vertex_colors,
                   const std::stop_token& stop) {
    RIMLINE_CHECK(vertex_colors.size() == source.positions.size());
    std::vector<glm::vec3>& colors = source.materials.corner_colors;
    colors.reserve(3 * source.triangles.size());
    for (std::size_t i = 0; i < source.triangles.size(); ++i) {
        if (i % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        for (const std::uint32_t corner : source.triangles[i])
            colors.push_back(vertex_colors[corner]);
    }
}

void color_vertices_and_triangles(MeshSource& source, std::span<const glm::vec3> vertex_colors,
                                  std::span<const glm::vec3> triangle_colors,
                                  const std::stop_token& stop) {
    RIMLINE_CHECK(triangle_colors.empty() || triangle_colors.size() == source.triangles.size());
    const bool has_own = std::ranges::any_of(
        triangle_colors, [](const glm::vec3& color) { return color != k_no_color; });
    if (vertex_colors.empty() && !has_own) return;
    whiten_triangles(source);
    std::vector<glm::vec3>& corners = source.materials.corner_colors;
    if (!vertex_colors.empty())
        color_corners(source, vertex_colors, stop);
    else
        corners.resize(3 * source.triangles.size(), glm::vec3(1.0f));
    if (!has_own) return;
    for (std::size_t t = 0; t < source.triangles.size(); ++t) {
        if (t % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        if (triangle_colors[t] != k_no_color) {
            for (std::size_t c = 0; c < 3; ++c) corners[3 * t + c] *= triangle_colors[t];
        } else if (vertex_colors.empty()) {
            source.materials.of_face[t] = k_no_material;
        }
    }
}

void drop_unused_materials(MeshSource& source) noexcept {
    const auto has_none = [](MaterialId material) { return material == k_no_material; };
    FaceMaterials& materials = source.materials;
    if (std::ranges::all_of(materials.of_face, has_none)) materials = {};
    for (std::size_t face = 0; face < materials.of_face.size(); ++face)
        if (materials.texture_of(face) != k_no_texture) return;
    materials.corner_uvs = {};
}

std::vector<bool> used_textures(const FaceMaterials& materials) {
    std::vector<bool> used(materials.textures.size());
    for (std::size_t face = 0; face < materials.of_face.size(); ++face)
        if (const TextureId texture = materials.texture_of(face); texture != k_no_texture)
            used[index(texture)] = true;
    return used;
}

void add_warning(std::vector<std::string>& warnings, std::string_view warning) {
    constexpr std::size_t k_max_warnings = 20;
    if (warnings.size() < k_max_warnings)
        warnings.push_back(printable_text(warning));
    else if (warnings.size() == k_max_warnings)
        warnings.emplace_back("there are more warnings about this file");
}

}  // namespace rimline
