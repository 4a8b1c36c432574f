#include "tools/bench/mesh_variants.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

namespace rimline::tools {

namespace {

MeshSource source_of(const Mesh& mesh) {
    MeshSource source{{mesh.positions().begin(), mesh.positions().end()}, {}, mesh.up()};
    for (const Triangle& triangle : mesh.triangles())
        source.triangles.push_back({index(triangle[0]), index(triangle[1]), index(triangle[2])});
    return source;
}

// The same on every machine, unlike std's distributions.
double unit(std::mt19937& random) { return double(random() >> 5) * 0x1p-27; }

glm::dvec3 random_direction(std::mt19937& random) {
    for (;;) {
        const double x = 2.0 * unit(random) - 1.0;
        const double y = 2.0 * unit(random) - 1.0;
        const double z = 2.0 * unit(random) - 1.0;
        const glm::dvec3 v(x, y, z);
        if (const double length = glm::length(v); length > 0.1 && length < 1.0) return v / length;
    }
}

}  // namespace

MeshSource with_noise(const Mesh& mesh, double share, std::uint32_t seed) {
    MeshSource source = source_of(mesh);
    std::mt19937 random(seed);
    for (glm::vec3& position : source.positions)
        position =
            glm::vec3(glm::dvec3(position) + share * mesh.radius() * random_direction(random));
    return source;
}

MeshSource bent(const Mesh& mesh, const glm::dvec3& up, double degrees) {
    MeshSource source = source_of(mesh);
    const glm::dvec3 axis = glm::normalize(up);
    const glm::dvec3 size = glm::dvec3(mesh.bounds().high) - glm::dvec3(mesh.bounds().low);
    glm::dvec3 along(0.0);
    double length = 0.0;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 e(0.0);
        e[i] = 1.0;
        if (std::abs(glm::dot(e, axis)) > 0.5 || size[i] <= length) continue;
        along = glm::normalize(e - glm::dot(e, axis) * axis);
        length = size[i];
    }
    if (length == 0.0) return source;
    const glm::dvec3 across = glm::cross(axis, along);
    const double bend_radius = length / glm::radians(degrees);
    for (glm::vec3& position : source.positions) {
        const glm::dvec3 p = glm::dvec3(position) - mesh.center();
        const double x = glm::dot(p, along);
        const double y = glm::dot(p, across);
        const double angle = x / bend_radius;
        const double from_axis = y - bend_radius;
        position = glm::vec3(mesh.center() + glm::dot(p, axis) * axis -
                             std::sin(angle) * from_axis * along +
                             (std::cos(angle) * from_axis + bend_radius) * across);
    }
    return source;
}

}  // namespace rimline::tools
