#include "tools/bench/light_measures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/corner_normals.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_measured_side_px = 512;
constexpr std::uint32_t k_shadow_px = 2048;
constexpr double k_lamp_radii = 40.0;
// Share of the mesh's radius.
constexpr double k_shadow_tolerance = 4e-3;
// Neighboring pixels farther apart than this show different parts of the surface.
constexpr double k_jump = 0.04;

Camera close_camera(const Mesh& mesh, const glm::dvec3& eye) {
    const glm::dvec3 back = glm::normalize(eye - mesh.center());
    const glm::dvec3 up = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return zoom_camera({.eye = eye, .target = mesh.center(), .up = up}, mesh, 1.0);
}

}  // namespace

LitView::LitView(const Mesh& mesh, const glm::dvec3& eye) : mesh_(mesh) {
    const ItemBuffer buffer(mesh, close_camera(mesh, eye), k_measured_side_px, k_measured_side_px);
    const std::vector<glm::vec3> normals = corner_normals(mesh, RendererOptions{}.crease_angle_rad);
    pixels_.resize(std::size_t{k_measured_side_px} * k_measured_side_px);
    for (std::uint32_t y = 0; y < k_measured_side_px; ++y)
        for (std::uint32_t x = 0; x < k_measured_side_px; ++x) {
            const FaceId face = buffer.face(x, y);
            if (face == k_no_face) continue;
            Pixel& pixel = pixels_[std::size_t{y} * k_measured_side_px + x];
            const glm::dvec3 weights = buffer.corner_weights(x, y);
            std::array<glm::dvec3, 3> corners;
            glm::dvec3 normal(0.0);
            for (std::size_t i = 0; i < 3; ++i) {
                const Triangle& triangle = mesh.triangles()[index(face)];
                corners[i] = glm::dvec3(mesh.positions()[index(triangle[i])]);
                pixel.place += weights[int(i)] * corners[i];
                normal += weights[int(i)] * glm::dvec3(normals[3 * index(face) + i]);
            }
            pixel.face_normal =
                glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            // Surfaces are lit on the visible side.
            const double side = glm::dot(pixel.face_normal, eye - pixel.place) < 0.0 ? -1.0 : 1.0;
            pixel.face_normal *= side;
            pixel.normal = side * glm::normalize(normal);
            pixel.is_surface = true;
        }
}

LightMeasure LitView::measure(const glm::dvec3& sun) const {
    const glm::dvec3 lamp = mesh_.center() + k_lamp_radii * mesh_.radius() * sun;
    const ItemBuffer lit(mesh_, close_camera(mesh_, lamp), k_shadow_px, k_shadow_px);
    const double tolerance = k_shadow_tolerance * mesh_.radius();
    LightMeasure sums;
    double surface = 0.0, steps = 0.0;
    const auto cosine = [&](const Pixel& pixel) {
        return std::max(0.0, glm::dot(pixel.normal, sun));
    };
    for (std::uint32_t y = 0; y + 1 < k_measured_side_px; ++y)
        for (std::uint32_t x = 0; x + 1 < k_measured_side_px; ++x) {
            const Pixel& pixel = pixels_[std::size_t{y} * k_measured_side_px + x];
            if (!pixel.is_surface) continue;
            surface += 1.0;
            const bool is_away = glm::dot(pixel.face_normal, sun) <= 0.0;
            sums.away += is_away;
            sums.unlit += is_away || !lit.sees(pixel.place, tolerance);
            const Pixel& right = pixels_[std::size_t{y} * k_measured_side_px + x + 1];
            const Pixel& below = pixels_[std::size_t{y + 1} * k_measured_side_px + x];
            const auto joins = [&](const Pixel& other) {
                return other.is_surface &&
                       glm::distance(other.place, pixel.place) < k_jump * mesh_.radius();
            };
            if (!joins(right) || !joins(below)) continue;
            steps += 1.0;
            sums.contrast +=
                std::hypot(cosine(right) - cosine(pixel), cosine(below) - cosine(pixel));
        }
    sums.away /= std::max(surface, 1.0);
    sums.unlit /= std::max(surface, 1.0);
    sums.contrast *= 0.01 * k_measured_side_px / std::max(steps, 1.0);
    return sums;
}

}  // namespace rimline::tools
