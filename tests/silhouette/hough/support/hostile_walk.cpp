#include "tests/silhouette/hough/support/hostile_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rimline::tests {

namespace {

HomogeneousPoint rounded(glm::dvec3 p, bool is_direction) {
    constexpr glm::dvec3 k_most(double{k_max_coordinate});
    const glm::vec3 v(glm::clamp(p, -k_most, k_most));
    return is_direction ? HomogeneousPoint::direction(v) : HomogeneousPoint::viewpoint(v);
}

glm::dvec3 normal_of(const Plane& plane) { return {plane.nx, plane.ny, plane.nz}; }

}  // namespace

const Plane& HostilePoints::random_plane() {
    static constexpr Plane k_any{0.0f, 1.0f, 0.0f, 0.0f};
    const std::uint32_t faces = mesh_->face_count();
    return faces == 0 ? k_any : mesh_->plane(FaceId{probes_.random_below(faces)});
}

HomogeneousPoint HostilePoints::nudged(const HomogeneousPoint& point, std::uint32_t most) {
    glm::vec3 v = point.xyz();
    for (int i = 0; i < 3; ++i) {
        const float end = probes_.random_below(2) == 0 ? -k_max_coordinate : k_max_coordinate;
        for (std::uint32_t steps = probes_.random_below(most + 1); steps > 0; --steps)
            v[i] = v[i] == 0.0f ? std::copysign(k_min_point_component, end)
                                : std::nextafter(v[i], end);
    }
    return rounded(glm::dvec3(v), point.is_direction());
}

HomogeneousPoint HostilePoints::onto_plane(const HomogeneousPoint& point) {
    const Plane& plane = random_plane();
    if (!plane.has_normal()) return point;
    const glm::dvec3 n = normal_of(plane);
    const glm::dvec3 p(point.xyz());
    const double height = glm::dot(n, p) - double{point.w} * double{plane.d};
    return rounded(p - n * (height / glm::dot(n, n)), point.is_direction());
}

HomogeneousPoint HostilePoints::on_three_planes() {
    const Plane a = random_plane();
    const Plane b = random_plane();
    const Plane c = random_plane();
    const glm::dmat3 normals(normal_of(a), normal_of(b), normal_of(c));  // As columns.
    if (!(std::abs(glm::determinant(normals)) > 1e-9)) return probes_.next();
    return rounded(glm::dvec3(a.d, b.d, c.d) * glm::inverse(normals), false);
}

HomogeneousPoint HostilePoints::next() {
    switch (probes_.random_below(10)) {
        case 0:
        case 1: return nudged(probes_.next(), 2);
        case 2:
        case 3: return nudged(onto_plane(probes_.next()), 3);
        case 4: return onto_plane(probes_.next());
        case 5: return nudged(on_three_planes(), 1);
        case 6: {
            const double size = std::exp2(probes_.uniform(30.0, 60.0));
            const glm::dvec3 p(probes_.next().xyz());
            const glm::dvec3 far = p * (size / std::max(glm::length(p), 1e-30));
            const HomogeneousPoint point = rounded(far, probes_.random_below(2) == 0);
            return probes_.random_below(2) == 0 ? point : onto_plane(point);
        }
        case 7: {
            const glm::dvec3 p(probes_.next().xyz());
            const double size = std::exp2(probes_.uniform(-60.0, -10.0));
            return rounded(p * (size / std::max(glm::length(p), 1e-30)),
                           probes_.random_below(2) == 0);
        }
        default: return probes_.next();
    }
}

HomogeneousPoint HostileWalk::next() {
    const HomogeneousPoint from = point_;
    point_ = moved();
    previous_ = from;
    return point_;
}

HomogeneousPoint HostileWalk::moved() {
    ProbePoints& probes = points_.probes();
    const auto step = [&](double low, double high) {
        return probes.radius() * std::exp2(probes.uniform(low, high));
    };
    switch (probes.random_below(16)) {
        case 0:
        case 1: return points_.nudged(point_, 1);
        case 2: return points_.nudged(point_, 4);
        case 3:
        case 4: return points_.nudged(points_.onto_plane(point_), 2);
        case 5: return probes.near(point_, step(-26.0, -8.0));
        case 6: return probes.near(point_, step(-8.0, -3.0));
        case 7: return probes.near(point_, step(-3.0, 2.0));
        case 8:
        case 9: return points_.next();
        case 10:
        case 11: return previous_;
        case 12: return probes.other_kind(point_);
        case 13: return home_;
        case 14: return home_ = points_.nudged(home_, 1);
        default: return point_;
    }
}

}  // namespace rimline::tests
