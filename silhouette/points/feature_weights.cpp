#include "silhouette/points/feature_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/points/each_point.h"
#include "silhouette/points/umbrella_triangles.h"

namespace rimline {

namespace {

// By sine and cosine: the cosine alone is inaccurate near 0.
double angle_between_lines(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), std::abs(glm::dot(a, b)));
}

// Of the normals of the point's umbrellas that nearest to `normal`; `normal` itself where there is none.
glm::dvec3 nearest_normal(const PointSurface& surface, PointId point, const glm::dvec3& normal) {
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    glm::dvec3 nearest = normal;
    double max_cosine = -1.0;
    for (std::uint32_t u = range.first; u < range.last; ++u) {
        const glm::dvec3 candidate = surface.umbrella(UmbrellaId{u}).normal;
        const double cosine = std::abs(glm::dot(candidate, normal));
        if (cosine > max_cosine) {
            max_cosine = cosine;
            nearest = candidate;
        }
    }
    return nearest;
}

struct RingTriangle {
    std::array<PointId, 2> corners;  // Beside the point itself.
    UmbrellaId umbrella;
    PointId corner(bool second) const { return corners[second ? 1 : 0]; }
};

class Weigher {
public:
    explicit Weigher(const PointSurface& surface) : surface_(surface) {}

    double weight(PointId point) {
        triangles_.clear();
        for_each_triangle(surface_, point, [&](PointId from, PointId to, UmbrellaId umbrella) {
            triangles_.push_back({{from, to}, umbrella});
        });
        double max_angle = 0.0;
        // Two triangles that share a corner lie on either side of an edge.
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            for (std::size_t k = i + 1; k < triangles_.size(); ++k) {
                const RingTriangle& a = triangles_[i];
                const RingTriangle& b = triangles_[k];
                for (const bool a_ends : {false, true})
                    for (const bool b_ends : {false, true})
                        if (a.corner(a_ends) == b.corner(b_ends))
                            max_angle = std::max(max_angle,
                                                 angle(a, a.corner(!a_ends), b, b.corner(!b_ends)));
            }
        return std::min(max_angle / (std::numbers::pi / 2), 1.0);
    }

private:
    double angle(const RingTriangle& a, PointId r, const RingTriangle& b, PointId s) const {
        const auto normal = [&](const RingTriangle& triangle, PointId point) {
            return nearest_normal(surface_, point, surface_.umbrella(triangle.umbrella).normal);
        };
        return r == s ? 0.0 : angle_between_lines(normal(a, r), normal(b, s));
    }

    const PointSurface& surface_;
    std::vector<RingTriangle> triangles_;
};

}  // namespace

std::vector<float> feature_weights(const PointSurface& surface, const LongCall& call) {
    std::vector<float> weights(surface.size());
    each_point(surface.size(), {call}, [&](std::uint32_t first, std::uint32_t last) {
        Weigher weigher(surface);
        for (std::uint32_t p = first; p < last; ++p)
            weights[p] = static_cast<float>(weigher.weight(PointId{p}));
    });
    return weights;
}

}  // namespace rimline
