#include "silhouette/mesh/creases.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

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

std::vector<Crease> find_creases(const Mesh& mesh, float min_bend_rad) {
    std::vector<Crease> creases;
    const std::uint32_t border = mesh.edges_of_class(EdgeClass::border).first;
    std::vector<float> bends(border);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, border, 4096), [&](const auto& run) {
        for (std::uint32_t e = run.begin(); e < run.end(); ++e)
            bends[e] = static_cast<float>(bend_of(mesh, EdgeId{e}));
    });
    for (std::uint32_t e = 0; e < border; ++e)
        if (bends[e] >= min_bend_rad && bends[e] > 0.0f) creases.push_back({EdgeId{e}, bends[e]});
    std::ranges::sort(creases, [](const Crease& a, const Crease& b) {
        return a.bend_rad != b.bend_rad ? a.bend_rad > b.bend_rad : a.edge < b.edge;
    });
    return creases;
}

}  // namespace rimline
