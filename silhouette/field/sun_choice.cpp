#include "silhouette/field/sun_choice.h"

#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/field/best_views.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/winding.h"

namespace rimline {

namespace {

std::vector<FaceId> faces_towards(const Mesh& mesh, const glm::dvec3& eye) {
    const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(eye));
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        if (is_front(mesh.plane(FaceId{f}), point)) faces.push_back(FaceId{f});
    return faces;
}

std::optional<ChosenSun> sun_of(const Mesh& mesh, const glm::dvec3& eye, const LongCall& call) {
    const std::vector<FaceId> faces = faces_towards(mesh, eye);
    if (faces.empty()) return std::nullopt;
    const TangentialField field(UnitPlanes(mesh, faces), light_function(), {}, call.stop);
    const PointsOfInterest found = find_points_of_interest(field, k_view_shell, {}, call);
    if (found.points.empty()) return std::nullopt;
    return ChosenSun{.direction = glm::normalize(found.points[0].point),
                     .votes = found.points[0].votes,
                     .faces = static_cast<std::uint32_t>(faces.size())};
}

}  // namespace

std::optional<ChosenSun> choose_sun(const Mesh& mesh, const glm::dvec3& eye, const LongCall& call) {
    if (is_inside_out(mesh)) return sun_of(turned_inside_out(mesh), eye, call);
    std::optional<ChosenSun> sun = sun_of(mesh, eye, call);
    if (!sun) {
        sun = sun_of(turned_inside_out(mesh), eye, call);
        if (sun) sun->sees_backs = true;
    }
    return sun;
}

}  // namespace rimline
