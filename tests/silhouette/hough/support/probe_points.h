#pragma once

// Silhouette points where a test of boxes, planes and bits is likeliest to go wrong, and ordinary ones.

#include <cstdint>
#include <random>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tests {

/// An endless random mixture: on vertices, on edges, on planes inside and outside their triangles, at
/// the center and at 0, inside the bounds, around the mesh, near the center, far, and directions, at
/// random, along axes, along edges and of no length. The same for the same seed.
class ProbePoints {
public:
    ProbePoints(const Mesh& mesh, std::uint64_t seed);

    HomogeneousPoint next();
    /// A viewpoint at about `distance` from `point`, which a direction is taken to be one from the
    /// center for.
    HomogeneousPoint near(const HomogeneousPoint& point, double distance);
    /// The direction from the center to a viewpoint, or a viewpoint from the center in a direction.
    HomogeneousPoint other_kind(const HomogeneousPoint& point) const;

    double radius() const { return radius_; }
    std::uint32_t random_below(std::uint32_t count);
    double uniform(double low, double high);

private:
    glm::dvec3 unit_vector();
    glm::dvec3 on_random_plane();

    const Mesh* mesh_;
    std::mt19937_64 random_;
    glm::dvec3 center_;
    double radius_;
};

}  // namespace rimline::tests
