#pragma once

// Where Hough spaces may have their origins: on the mesh, beside it, far from it, and several at once.

#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline::tests {

inline std::vector<std::vector<glm::dvec3>> origin_lists(const Mesh& mesh) {
    const double r = mesh.radius();
    const glm::dvec3 c = mesh.center();
    const glm::dvec3 zero(0.0);
    const glm::dvec3 vertex = mesh.vertex_count() > 0 ? glm::dvec3(mesh.positions()[0]) : c;
    const glm::dvec3 beside = c + glm::dvec3(r / 3.0, r / 7.0, -r / 5.0);
    const glm::dvec3 outside = c + glm::dvec3(-1.4 * r, 0.3 * r, 1.1 * r);
    const glm::dvec3 far = c + glm::dvec3(0.0, 100.0 * r, 0.0);
    return {{zero},      {vertex},         {beside},        {far},
            {c, beside}, {beside, beside}, {zero, outside}, {vertex, outside, far, c, beside}};
}

}  // namespace rimline::tests
