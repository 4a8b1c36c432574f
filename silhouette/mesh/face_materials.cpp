#include "silhouette/mesh/face_materials.h"

#include <algorithm>

namespace rimline {

bool are_materials_of(const FaceMaterials& materials, std::size_t face_count) noexcept {
    if (materials.empty()) return materials.corner_colors.empty();
    const bool has_sizes =
        materials.of_face.size() == face_count &&
        (materials.corner_colors.empty() || materials.corner_colors.size() == 3 * face_count);
    return has_sizes && std::ranges::all_of(materials.of_face, [&](MaterialId material) {
               return material == k_no_material || index(material) < materials.materials.size();
           });
}

}  // namespace rimline
