#include "tools/bent_faces.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/points/umbrella_triangles.h"

namespace rimline::tools {

namespace {

constexpr std::size_t k_most_faces = 3;
const double k_flat_cosine = std::cos(25.0 * std::numbers::pi / 180.0);

struct Triangle {
    glm::dvec3 normal;  // Of length 1.
    glm::dvec3 middle;
    double angle;  // At the point.
};

std::vector<Triangle> triangles_of(const PointSurface& surface, PointId point) {
    const std::span<const glm::dvec3> positions = surface.positions();
    std::vector<Triangle> triangles;
    for_each_triangle(surface, point, [&](PointId from, PointId to, UmbrellaId) {
        const auto direction = [&](PointId q) {
            return glm::normalize(positions[index(q)] - positions[index(point)]);
        };
        const glm::dvec3 a = direction(from), b = direction(to), cross = glm::cross(a, b);
        const double sine = glm::length(cross);
        if (sine > 1e-9)
            triangles.push_back({cross / sine, a + b, std::atan2(sine, glm::dot(a, b))});
    });
    return triangles;
}

}  // namespace

std::vector<BentFace> bent_faces(const PointSurface& surface, PointId point) {
    const std::vector<Triangle> triangles = triangles_of(surface, point);
    if (triangles.empty()) return {};
    // Each seed is the triangle farthest from all before it.
    std::vector<glm::dvec3> seeds{triangles[0].normal};
    const auto nearest_seed = [&](const Triangle& triangle) {
        std::size_t nearest = 0;
        for (std::size_t s = 1; s < seeds.size(); ++s)
            if (glm::dot(triangle.normal, seeds[s]) > glm::dot(triangle.normal, seeds[nearest]))
                nearest = s;
        return nearest;
    };
    while (seeds.size() < k_most_faces) {
        const Triangle* farthest = nullptr;
        double least = k_flat_cosine;
        for (const Triangle& triangle : triangles) {
            const double cosine = glm::dot(triangle.normal, seeds[nearest_seed(triangle)]);
            if (cosine >= least) continue;
            least = cosine;
            farthest = &triangle;
        }
        if (!farthest) break;
        seeds.push_back(farthest->normal);
    }
    std::vector<BentFace> faces(seeds.size(), {glm::dvec3(0.0), glm::dvec3(0.0)});
    for (const Triangle& triangle : triangles) {
        BentFace& face = faces[nearest_seed(triangle)];
        face.normal += triangle.angle * triangle.normal;
        face.middle += triangle.angle * triangle.middle;
    }
    for (BentFace& face : faces) face.normal = glm::normalize(face.normal);
    return faces;
}

}  // namespace rimline::tools
