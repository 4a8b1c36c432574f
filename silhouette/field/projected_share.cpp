#include "silhouette/field/projected_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rimline {

namespace {

// Of the surface, by the square of the mesh's radius.
glm::dmat3 covariance_of(const Mesh& mesh) {
    glm::dmat3 sum(0.0);
    glm::dvec3 mean(0.0);
    double area = 0.0;
    const double scale = mesh.radius() > 0.0 ? 1.0 / mesh.radius() : 1.0;
    for (const Triangle& triangle : mesh.triangles()) {
        std::array<glm::dvec3, 3> corners{};
        glm::dvec3 total(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 position(mesh.positions()[index(triangle[i])]);
            corners[i] = scale * (position - mesh.center());
            total += corners[i];
        }
        const double a = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (const glm::dvec3& corner : corners) sum += a * glm::outerProduct(corner, corner);
        sum += a * glm::outerProduct(total, total);
        mean += a / 3.0 * total;
        area += a;
    }
    if (area <= 0.0) return glm::dmat3(0.0);
    mean /= area;
    return sum / (12.0 * area) - glm::outerProduct(mean, mean);
}

// Symmetric, by its columns.
glm::dmat3 adjugate_of(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Of a symmetric matrix (Smith 1961).
double largest_eigenvalue(const glm::dmat3& m) {
    const double q = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    const glm::dmat3 rest = m - glm::dmat3(q);
    double squares = 0.0;
    for (int i = 0; i < 3; ++i) squares += glm::dot(rest[i], rest[i]);
    const double p = std::sqrt(squares / 6.0);
    if (p <= 0.0) return q;
    const double half = 0.5 * glm::determinant(rest / p);
    return q + 2.0 * p * std::cos(std::acos(std::clamp(half, -1.0, 1.0)) / 3.0);
}

}  // namespace

ProjectedShare::ProjectedShare(const Mesh& mesh) {
    const glm::dmat3 adjugate = adjugate_of(covariance_of(mesh));
    const double largest = largest_eigenvalue(adjugate);
    // Below are roundings of the moments of a line.
    constexpr double k_least = 1e-24;
    if (largest > k_least) adjugate_ = adjugate / largest;
}

double ProjectedShare::operator()(const glm::dvec3& direction) const {
    if (adjugate_ == glm::dmat3(0.0)) return 1.0;
    const glm::dvec3 d = glm::normalize(direction);
    return std::sqrt(std::clamp(glm::dot(d, adjugate_ * d), 0.0, 1.0));
}

}  // namespace rimline
