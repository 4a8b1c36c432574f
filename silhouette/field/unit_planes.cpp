#include "silhouette/field/unit_planes.h"

#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/mesh/winding.h"

namespace rimline {

UnitFrame unit_frame(const Mesh& mesh) {
    return {mesh.center(), mesh.radius() > 0.0 ? mesh.radius() : 1.0};
}

UnitPlanes::UnitPlanes(const Mesh& mesh, const std::stop_token& stop) : frame_(unit_frame(mesh)) {
    const LongCall call{stop, {}};
    normals_.reserve(mesh.face_count());
    offsets_.reserve(mesh.face_count());
    areas_.reserve(mesh.face_count());
    faces_.reserve(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (f % k_planes_a_checkpoint == 0) call.checkpoint(0.0);
        add(mesh, FaceId{f});
    }
}

UnitPlanes::UnitPlanes(const Mesh& mesh, std::span<const FaceId> faces) : frame_(unit_frame(mesh)) {
    for (const FaceId face : faces) {
        RIMLINE_CHECK(index(face) < mesh.face_count());
        add(mesh, face);
    }
}

void UnitPlanes::add(const Mesh& mesh, FaceId face) {
    const Plane& plane = mesh.plane(face);
    if (!plane.has_normal()) return;
    const Triangle& triangle = mesh.triangles()[index(face)];
    const auto corner = [&](std::size_t i) {
        return frame_.from_model(glm::dvec3(mesh.positions()[index(triangle[i])]));
    };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 normal = glm::normalize(plane.normal());
    normals_.push_back(normal);
    offsets_.push_back(glm::dot(normal, a));
    areas_.push_back(0.5 * glm::length(glm::cross(corner(1) - a, corner(2) - a)));
    faces_.push_back(face);
}

UnitPlanes outward_planes(const Mesh& mesh, const std::stop_token& stop) {
    return is_inside_out(mesh) ? UnitPlanes(turned_inside_out(mesh), stop) : UnitPlanes(mesh, stop);
}

}  // namespace rimline
