#include "silhouette/points/pca_normals.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

TEST_CASE("principal components give a plane's normal exactly and a sphere's nearly") {
    for (const glm::dvec3& normal : pca_normals(tests::make_patch(20, 0.3, 1).points, 12))
        CHECK(std::abs(normal.z) > 1.0 - 1e-12);
    const std::vector<glm::dvec3> sphere = tests::make_sphere(3000);
    const std::vector<glm::dvec3> normals = pca_normals(sphere, 12);
    for (std::size_t i = 0; i < sphere.size(); ++i)
        CHECK(std::abs(glm::dot(normals[i], sphere[i])) > 0.999);
}

TEST_CASE("principal components of points in a line or alone give no normal") {
    CHECK(pca_normals({}, 8).empty());
    std::vector<glm::dvec3> line;
    for (int i = 0; i < 20; ++i) line.push_back({double(i), 2.0 * i, 0.0});
    for (const glm::dvec3& normal : pca_normals(line, 8)) CHECK(normal == glm::dvec3(0.0));
    CHECK(pca_normals(std::vector<glm::dvec3>{{1, 2, 3}}, 8)[0] == glm::dvec3(0.0));
}

}  // namespace
}  // namespace rimline
