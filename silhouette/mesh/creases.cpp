#include "silhouette/mesh/creases.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/error.h"
#include "silhouette/mesh/angle_between.h"

namespace rimline {

double bend_of(const Mesh& mesh, EdgeId edge) {
    const std::span<const FaceId> faces = mesh.faces_of(edge);
    const EdgeClass edge_class = mesh.edge_class(edge);
    double bend = 0.0;
    const Plane& first = mesh.plane(faces[0]);
    for (const FaceId face : faces.subspan(1)) {
        const Plane& other = mesh.plane(face);
        if (!first.has_normal() || !other.has_normal()) continue;
        const double angle = angle_between(first.normal(), other.normal());
        const double turned = std::numbers::pi - angle;
        bend = std::max(bend, edge_class == EdgeClass::regular        ? angle
                              : edge_class == EdgeClass::inconsistent ? turned
                                                                      : std::min(angle, turned));
    }
    return bend;
}

std::vector<Crease> find_creases(const Mesh& mesh, float min_bend_rad,
                                 const std::stop_token& stop) {
    const std::uint32_t border = mesh.edges_of_class(EdgeClass::border).first;
    const Mesh::EdgeRange regular = mesh.edges_of_class(EdgeClass::regular);
    // Of most edges the cosine tells that they bend by less, for a twentieth of an angle's time. Normals are
    // rounded to float.
    const double min_cos = std::cos(double{min_bend_rad}) + 1e-5;
    const auto bends_less = [&](std::uint32_t e) {
        if (e < regular.first || e >= regular.last) return false;
        const auto& faces = mesh.edge(EdgeId{e}).faces;
        return glm::dot(mesh.plane(faces[0]).normal(), mesh.plane(faces[1]).normal()) > min_cos;
    };
    std::vector<float> bends(border);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, border, 4096), [&](const auto& run) {
        LongCall{stop, {}}.checkpoint(0.0);
        for (std::uint32_t e = run.begin(); e < run.end(); ++e)
            if (!bends_less(e)) bends[e] = static_cast<float>(bend_of(mesh, EdgeId{e}));
    });
    std::vector<Crease> creases;
    for (std::uint32_t e = 0; e < border; ++e)
        if (bends[e] >= min_bend_rad && bends[e] > 0.0f) creases.push_back({EdgeId{e}, bends[e]});
    LongCall{stop, {}}.checkpoint(0.0);
    std::ranges::sort(creases, [](const Crease& a, const Crease& b) {
        return a.bend_rad != b.bend_rad ? a.bend_rad > b.bend_rad : a.edge < b.edge;
    });
    return creases;
}

}  // namespace rimline
