#include "tests/silhouette/hough/support/probe_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline::tests {

namespace {

glm::vec3 rounded(glm::dvec3 p) {
    constexpr double k_most = double{k_max_coordinate};
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], -k_most, k_most);
    return glm::vec3(p);
}

HomogeneousPoint viewpoint(glm::dvec3 p) { return HomogeneousPoint::viewpoint(rounded(p)); }
HomogeneousPoint direction(glm::dvec3 v) { return HomogeneousPoint::direction(rounded(v)); }

}  // namespace

ProbePoints::ProbePoints(const Mesh& mesh, std::uint64_t seed)
    : mesh_(&mesh),
      random_(seed),
      center_(mesh.center()),
      radius_(mesh.radius() > 0.0 ? mesh.radius() : 1.0) {}

std::uint32_t ProbePoints::random_below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
}

double ProbePoints::uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
}

glm::dvec3 ProbePoints::unit_vector() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random_), normal(random_), normal(random_)));
}

glm::dvec3 ProbePoints::on_random_plane() {
    const Triangle& t = mesh_->triangles()[random_below(mesh_->face_count())];
    const glm::dvec3 a(mesh_->positions()[index(t[0])]);
    const glm::dvec3 b(mesh_->positions()[index(t[1])]);
    const glm::dvec3 c(mesh_->positions()[index(t[2])]);
    // In triangles, along their edges, and far out in their planes.
    const double spread = std::exp2(uniform(0.0, 10.0));
    return a + uniform(-spread, spread) * (b - a) + uniform(-spread, spread) * (c - a);
}

HomogeneousPoint ProbePoints::next() {
    const bool empty = mesh_->face_count() == 0;
    const std::uint32_t kind = random_below(16);
    switch (empty && kind < 6 ? 8u : kind) {
        case 0:
        case 1:
            return viewpoint(glm::dvec3(mesh_->positions()[random_below(mesh_->vertex_count())]));
        case 2:
        case 3: return viewpoint(on_random_plane());
        case 4: {
            const Triangle& t = mesh_->triangles()[random_below(mesh_->face_count())];
            return viewpoint(0.5 * (glm::dvec3(mesh_->positions()[index(t[0])]) +
                                    glm::dvec3(mesh_->positions()[index(t[1])])));
        }
        case 5: {
            const Triangle& t = mesh_->triangles()[random_below(mesh_->face_count())];
            return direction(glm::dvec3(mesh_->positions()[index(t[1])]) -
                             glm::dvec3(mesh_->positions()[index(t[0])]));
        }
        case 6:
            switch (random_below(3)) {
                case 0: return viewpoint(center_);
                case 1: return viewpoint(glm::dvec3(0.0));
                default: return direction(glm::dvec3(0.0));
            }
        case 7: {
            const glm::dvec3 low(mesh_->bounds().low);
            const glm::dvec3 high(mesh_->bounds().high);
            return viewpoint(
                glm::dvec3(uniform(low.x, high.x), uniform(low.y, high.y), uniform(low.z, high.z)));
        }
        case 8:
        case 9:
        case 10: return viewpoint(center_ + radius_ * uniform(1.0, 4.0) * unit_vector());
        case 11:
            return viewpoint(center_ + radius_ * std::exp2(uniform(-30.0, -1.0)) * unit_vector());
        case 12:
            return viewpoint(center_ + radius_ * std::exp2(uniform(2.0, 40.0)) * unit_vector());
        case 13: {
            glm::dvec3 axis(0.0);
            axis[static_cast<int>(random_below(3))] = random_below(2) == 0 ? -1.0 : 1.0;
            return random_below(2) == 0 ? direction(axis) : viewpoint(center_ + radius_ * axis);
        }
        default: return direction(std::exp2(uniform(-20.0, 20.0)) * unit_vector());
    }
}

HomogeneousPoint ProbePoints::near(const HomogeneousPoint& point, double distance) {
    const glm::dvec3 step = distance * unit_vector();
    if (point.is_direction()) return direction(glm::dvec3(point.xyz()) + step);
    return viewpoint(glm::dvec3(point.xyz()) + step);
}

HomogeneousPoint ProbePoints::other_kind(const HomogeneousPoint& point) const {
    const glm::dvec3 p(point.xyz());
    return point.is_direction() ? viewpoint(center_ + 2.0 * radius_ * p) : direction(p - center_);
}

}  // namespace rimline::tests
