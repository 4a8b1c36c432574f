#include "tools/output/line_materials.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/srgb.h"

namespace rimline::tools {

std::vector<Color> LineMaterials::inks_on_paper() const {
    std::vector<Color> inks;
    for (const glm::vec3& color : inks_.colors) {
        const glm::vec3 srgb = glm::round(255.0f * srgb_from_linear(line_shade(color, false)));
        inks.push_back({static_cast<std::uint8_t>(srgb.x), static_cast<std::uint8_t>(srgb.y),
                        static_cast<std::uint8_t>(srgb.z)});
    }
    return inks;
}

std::uint8_t LineMaterials::ink_of(EdgeId edge, const HomogeneousPoint& point) const {
    if (edge == k_no_edge || inks_.colors.empty()) return k_no_material_ink;
    const std::span<const FaceId> faces = mesh_->faces_of(edge);
    // The distance of the point from the plane of a face, negative behind it.
    const auto height = [&](FaceId face) {
        const Plane& plane = mesh_->plane(face);
        if (!plane.has_normal()) return -std::numeric_limits<double>::infinity();
        return glm::dot(plane.normal(), glm::dvec3(point.x, point.y, point.z)) -
               double{point.w} * double{plane.d};
    };
    const FaceId seen = std::ranges::max(faces, {}, height);
    return inks_.of_face[index(seen)];
}

}  // namespace rimline::tools
