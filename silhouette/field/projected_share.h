#pragma once

// How large a mesh appears from a direction. Votes know no lengths: all side faces of a pencil vote for a viewpoint
// before its end, from where the picture is a small disc.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The area of the projection of the ellipsoid with the mesh's moments of inertia (of its surface), as a share of the
/// largest one: 1 along the shortest axis, the ratio of shortest to longest axis along the longest. By moments instead
/// of pixels it is smooth, and the same for every triangulation.
class ProjectedShare {
public:
    /// O(faces).
    explicit ProjectedShare(const Mesh& mesh);

    /// In [0, 1]. 1 in all directions for a mesh along a line. `direction` is not zero.
    double operator()(const glm::dvec3& direction) const;

private:
    // In a direction d of length 1 the two moments of the projection have the product dᵀ adj(C) d, with the covariance C.
    glm::dmat3 adjugate_{0.0};  // By its largest eigenvalue.
};

}  // namespace rimline
