#include "silhouette/mesh/winding.h"

#include <glm/geometric.hpp>
#include <utility>

namespace rimline {

double enclosed_volume(const Mesh& mesh) {
    double sixfold = 0.0;
    for (const Triangle& triangle : mesh.triangles()) {
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(mesh.positions()[index(triangle[i])]) - mesh.center();
        };
        sixfold += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
    }
    return sixfold / 6.0;
}

bool is_inside_out(const Mesh& mesh) {
    return mesh.is_closed() && mesh.is_oriented() && enclosed_volume(mesh) < 0.0;
}

Mesh turned_inside_out(const Mesh& mesh) {
    MeshSource source{{mesh.positions().begin(), mesh.positions().end()}, {}, mesh.up()};
    source.is_up_known = mesh.is_up_known();
    source.triangles.reserve(mesh.face_count());
    for (const Triangle& triangle : mesh.triangles())
        source.triangles.push_back({index(triangle[0]), index(triangle[2]), index(triangle[1])});
    return Mesh(source);
}

}  // namespace rimline
