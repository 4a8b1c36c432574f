// Item buffers against rays traced one by one, and sight of points against spheres.

#include "tools/bench/item_buffer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr std::uint32_t k_side = 48;

// The nearest face that the ray through a pixel's center meets, and how far along; a plain loop
// (Möller, Trumbore 1997).
std::optional<std::pair<FaceId, double>> first_face(const Mesh& mesh, const glm::dvec3& from,
                                                    const glm::dvec3& ray) {
    std::optional<std::pair<FaceId, double>> first;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(mesh.positions()[index(mesh.triangles()[f][i])]);
        };
        const glm::dvec3 u = corner(1) - corner(0);
        const glm::dvec3 v = corner(2) - corner(0);
        const glm::dvec3 p = glm::cross(ray, v);
        const double determinant = glm::dot(u, p);
        if (determinant == 0.0) continue;
        const glm::dvec3 s = from - corner(0);
        const double a = glm::dot(s, p) / determinant;
        const glm::dvec3 q = glm::cross(s, u);
        const double b = glm::dot(ray, q) / determinant;
        const double along = glm::dot(v, q) / determinant;
        if (a < 0.0 || b < 0.0 || a + b > 1.0 || along <= 0.0) continue;
        if (!first || along < first->second) first = {FaceId{f}, along};
    }
    return first;
}

TEST_CASE("every pixel shows the face that its ray meets first and where" *
          doctest::test_suite("plain")) {
    for (const std::string name : {"knot", "spring", "scene", "terrain"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name, 600));
        const Camera camera{
            .eye = mesh.center() + 1.9 * mesh.radius() * glm::normalize(glm::dvec3(1, 0.7, 1.3)),
            .target = mesh.center(),
            .fov_y_deg = 66.0};
        const ItemBuffer buffer(mesh, camera, 2 * k_side, k_side);
        const glm::dmat3 axes = camera_from_world(camera);
        const double tangent = std::tan(glm::radians(33.0));
        std::uint32_t covered = 0, differ = 0;
        for (std::uint32_t y = 0; y < k_side; ++y)
            for (std::uint32_t x = 0; x < 2 * k_side; ++x) {
                const glm::dvec3 in_camera(tangent * ((x + 0.5) / (0.5 * k_side) - 2.0),
                                           tangent * (1.0 - (y + 0.5) / (0.5 * k_side)), -1.0);
                const glm::dvec3 ray = in_camera * axes;  // The transpose's product.
                const auto first = first_face(mesh, camera.eye, ray);
                const FaceId shown = buffer.face(x, y);
                covered += shown != k_no_face;
                // A ray along an edge may fall to either side.
                if ((first ? first->first : k_no_face) != shown) {
                    ++differ;
                    continue;
                }
                if (!first) continue;
                glm::dvec3 place(0.0);
                const glm::dvec3 weights = buffer.corner_weights(x, y);
                for (int i = 0; i < 3; ++i)
                    place += weights[i] * glm::dvec3(mesh.positions()[index(
                                              mesh.triangles()[index(shown)][std::size_t(i)])]);
                CHECK(glm::distance(place, camera.eye + first->second * ray) <
                      1e-9 * mesh.radius());
            }
        CHECK(differ <= 2);
        CHECK(covered == buffer.covered_pixels());
        CHECK(covered > 300);
    }
}

TEST_CASE("of a sphere the cap towards the eye is seen and nothing else") {
    const Mesh mesh(make_built_in_shape("sphere", 40000));
    const glm::dvec3 eye = mesh.center() + 2.0 * mesh.radius() * glm::dvec3(0.6, 0.0, 0.8);
    // Many faces are smaller than a pixel. Very near the rim, what is seen is a matter of pixels.
    const ItemBuffer buffer(mesh, {.eye = eye, .target = mesh.center(), .fov_y_deg = 62.0}, 512,
                            512);
    std::uint32_t seen = 0;
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 p(position);
        // Cosine of the angle to the eye as seen from the center; the rim is at radius / distance.
        const double cosine = glm::dot(glm::normalize(p - mesh.center()), glm::dvec3(0.6, 0, 0.8));
        const bool is_seen = buffer.sees(p, 2e-3 * mesh.radius());
        seen += is_seen;
        if (cosine > 0.6) CHECK(is_seen);
        if (cosine < 0.45) CHECK_FALSE(is_seen);
    }
    CHECK(seen > mesh.vertex_count() / 5);
}

}  // namespace
