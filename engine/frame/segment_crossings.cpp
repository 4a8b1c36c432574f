#include "engine/frame/segment_crossings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rimline {

namespace {

// Relative error of the arithmetic, with a margin.
constexpr double k_crossing_tolerance = 1e-12;

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double place =
        square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + place * along);
}

}  // namespace

Corners corners_from(const Mesh& mesh, FaceId face, const glm::dvec3& origin) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c)
        corners[c] = glm::dvec3(mesh.positions()[index(mesh.triangles()[index(face)][c])]) - origin;
    return corners;
}

double distance_between(const glm::dvec3& end, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double ee = glm::dot(end, end);
    const double eb = glm::dot(end, along);
    const double bb = glm::dot(along, along);
    const double determinant = ee * bb - eb * eb;
    double least =
        std::min({distance_to_segment(glm::dvec3(0.0), a, b), distance_to_segment(end, a, b),
                  distance_to_segment(a, glm::dvec3(0.0), end),
                  distance_to_segment(b, glm::dvec3(0.0), end)});
    if (determinant > 0.0) {
        // Where the lines are nearest.
        const double s = (glm::dot(end, a) * bb - glm::dot(along, a) * eb) / determinant;
        const double t = (glm::dot(end, a) * eb - glm::dot(along, a) * ee) / determinant;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
            least = std::min(least, glm::distance(s * end, a + t * along));
    }
    return least;
}

double distance_to_triangle(const glm::dvec3& point, const Corners& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    const auto is_within = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, point - from), normal) >= 0.0;
    };
    if (length > 0.0 && is_within(a, b) && is_within(b, c) && is_within(c, a))
        return std::abs(glm::dot(normal, point - a)) / length;
    return std::min({distance_to_segment(point, a, b), distance_to_segment(point, b, c),
                     distance_to_segment(point, c, a)});
}

Crossing crossing_of(const glm::dvec3& end, const Corners& corners) {
    double size = glm::length(end);
    for (const glm::dvec3& corner : corners) size = std::max(size, glm::length(corner));
    const double tolerance = k_crossing_tolerance * size * size * size;
    int positive = 0;
    int negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double volume = glm::dot(end, glm::cross(corners[i], corners[(i + 1) % 3]));
        positive += volume > tolerance ? 1 : 0;
        negative += volume < -tolerance ? 1 : 0;
    }
    if (positive > 0 && negative > 0) return Crossing::none;
    if (positive < 3 && negative < 3) return Crossing::unknown;
    const auto& [a, b, c] = corners;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double at_eye = glm::dot(normal, -a);
    const double at_end = glm::dot(normal, end - a);
    if (std::abs(at_eye) <= tolerance || std::abs(at_end) <= tolerance) return Crossing::unknown;
    if ((at_eye > 0.0) == (at_end > 0.0)) return Crossing::none;
    return at_end > 0.0 ? Crossing::from_front : Crossing::from_back;
}

std::optional<int> winding_number(const FaceTree& tree, const Mesh& mesh, const glm::dvec3& point,
                                  double margin) {
    const double size = glm::length(glm::dvec3(mesh.bounds().high) - glm::dvec3(mesh.bounds().low));
    const double slack = margin + 0x1p-22 * (size + glm::length(point));
    const bool is_near = tree.any_meeting(
        {glm::vec3(point - slack), glm::vec3(point + slack)}, [&](std::uint32_t face) {
            return distance_to_triangle(glm::dvec3(0.0), corners_from(mesh, FaceId{face}, point)) <=
                   margin;
        });
    if (is_near) return std::nullopt;
    // In no direction that meshes prefer.
    for (const glm::dvec3& direction :
         {glm::dvec3(0.834, 0.417, 0.361), glm::dvec3(-0.292, 0.911, -0.29),
          glm::dvec3(0.197, -0.53, 0.825)}) {
        const glm::dvec3 end = 2.0 * size * direction;
        int winding = 0;
        const bool is_unknown = tree.any_along(point, point + end, [&](std::uint32_t face) {
            const Crossing crossing = crossing_of(end, corners_from(mesh, FaceId{face}, point));
            winding += crossing == Crossing::from_front  ? 1
                       : crossing == Crossing::from_back ? -1
                                                         : 0;
            return crossing == Crossing::unknown;
        });
        if (!is_unknown) return winding;
    }
    return std::nullopt;
}

}  // namespace rimline
