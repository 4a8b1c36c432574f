#include "silhouette/lines/face_count.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/lines/exact_signs.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

glm::dvec3 ray_end(const LineGeometry& surface, const LineView& view, const glm::dvec3& point) {
    const glm::dvec3 eye(view.point().xyz());
    if (!view.is_orthographic()) return eye;
    const Mesh& mesh = surface.mesh();
    const double distance = 2.0 * (mesh.radius() + glm::length(point - mesh.center()));
    return point + distance * glm::normalize(eye);
}

namespace {

// Whether the line through a vertex along `towards` passes by a face, certainly: on different sides of two of its
// sides. The corners are given as differences from the vertex.
bool passes_by(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& towards, double bound) {
    bool has_left = false, has_right = false;
    const std::array<double, 3> lengths{length_1(corners[0]), length_1(corners[1]),
                                        length_1(corners[2])};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const double side = glm::dot(glm::cross(corners[k], corners[next]), towards);
        const double error = bound * lengths[k] * lengths[next];
        has_left |= side > error, has_right |= -side > error;
    }
    return has_left && has_right;
}

}  // namespace

std::span<const std::int32_t> VertexRays::count_before(const LineGeometry& surface,
                                                       const LineView& view,
                                                       std::span<const std::uint32_t> vertices) {
    const std::span<const glm::vec3> positions = surface.mesh().positions();
    const glm::dvec3 eye(view.point().xyz());
    rays_.clear();
    for (const std::uint32_t vertex : vertices) {
        const glm::dvec3 from(positions[vertex]);
        rays_.add(ray_end(surface, view, from), from);
    }
    counts_.assign(vertices.size(), 0);
    rays_.each_along(surface.tree(), [&](std::uint32_t ray, std::uint32_t face) {
        const std::uint32_t vertex = vertices[ray];
        const Triangle& t = surface.mesh().triangles()[face];
        if (has_corner(t, VertexId{vertex})) return;
        const glm::vec3 &a = positions[index(t[0])], &b = positions[index(t[1])],
                        &c = positions[index(t[2])], &p = positions[vertex];
        const glm::dvec3 from(p), towards = view.is_orthographic() ? eye : eye - from;
        if (passes_by({glm::dvec3(a) - from, glm::dvec3(b) - from, glm::dvec3(c) - from}, towards,
                      k_determinant_error * length_1(towards)))
            return;
        const int side = seen_side(view.point(), a, b, p);
        if (side != 0 && seen_side(view.point(), b, c, p) == side &&
            seen_side(view.point(), c, a, p) == side && plane_side(a, b, c, p) == -side &&
            seen_side(view.point(), a, b, c) == side)  // Else it lies behind the eye.
            ++counts_[ray];
    });
    return counts_;
}

bool is_covered(const LineGeometry& surface, const LineView& view, const glm::dvec2& place) {
    const Mesh& mesh = surface.mesh();
    const glm::dvec3 eye_to_center = mesh.center() - view.unproject({{0.0, 0.0}, 0.0});
    const glm::dvec3 behind =
        view.unproject({place, glm::length(eye_to_center) + 2.0 * mesh.radius()});
    return surface.tree().any_along(ray_end(surface, view, behind), behind, [&](std::uint32_t f) {
        const RayCount ray = meets_face(surface, view, behind, f);
        return ray.count > 0 || !ray.is_sure;
    });
}

RayCount meets_face(const LineGeometry& surface, const LineView& view, const glm::dvec3& point,
                    std::uint32_t face) {
    constexpr double k_error = 0x1p-44;
    const Triangle& t = surface.mesh().triangles()[face];
    const auto corner = [&](std::size_t k) {
        return glm::dvec3(surface.mesh().positions()[index(t[k % 3])]) - point;
    };
    const glm::dvec3 eye(view.point().xyz());
    const glm::dvec3 towards = view.is_orthographic() ? eye : eye - point;
    int sign = 0;
    bool is_sure = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 a = corner(k), b = corner(k + 1);
        const double side = glm::dot(glm::cross(a, b), towards);
        const double error = k_error * glm::length(a) * glm::length(b) * glm::length(towards);
        if (std::abs(side) <= error) {
            is_sure = false;
            continue;
        }
        const int s = side > 0.0 ? 1 : -1;
        if (sign == -s) return {0, true};
        sign = s;
    }
    const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const double size = glm::length(n);
    if (size == 0.0) return {0, true};
    const double height = -glm::dot(n, corner(0)) / size;  // Of the point over the face.
    const double facing = glm::dot(n, towards);
    if (std::abs(height) <= k_error * surface.mesh().radius()) return {0, false};
    if (view.is_orthographic()) return {int(height < 0.0) == int(facing > 0.0) ? 1 : 0, is_sure};
    const double eye_height = glm::dot(n, towards - corner(0)) / size;
    const bool is_between = (height < 0.0) != (eye_height < 0.0);
    return {is_between ? 1 : 0, is_sure || !is_between};
}

}  // namespace rimline
