#include "silhouette/mesh/face_materials.h"

#include <algorithm>
#include <cmath>

namespace rimline {

bool FaceMaterials::has_pictures() const noexcept {
    return !corner_uvs.empty() && std::ranges::any_of(textures, [](const MaterialTexture& texture) {
        return texture.picture != nullptr;
    });
}

bool are_materials_of(const FaceMaterials& materials, std::size_t face_count) noexcept {
    if (materials.empty()) return materials.corner_colors.empty() && materials.corner_uvs.empty();
    const auto is_of_corners = [&](const auto& list) {
        return list.empty() || list.size() == 3 * face_count;
    };
    return materials.of_face.size() == face_count && is_of_corners(materials.corner_colors) &&
           is_of_corners(materials.corner_uvs) &&
           std::ranges::all_of(materials.of_face,
                               [&](MaterialId material) {
                                   return material == k_no_material ||
                                          index(material) < materials.materials.size();
                               }) &&
           std::ranges::all_of(materials.materials,
                               [&](const SurfaceMaterial& material) {
                                   return material.texture == k_no_texture ||
                                          index(material.texture) < materials.textures.size();
                               }) &&
           std::ranges::all_of(materials.corner_uvs, [](const glm::vec2& uv) {
               return std::isfinite(uv.x) && std::isfinite(uv.y);
           });
}

}  // namespace rimline
