#include "tests/engine/support/rounded_pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace rimline::tests {

namespace {

constexpr double k_grid_px = 1.0 / 256;
constexpr double k_depth_share = 0x1p-20;

struct Plane {
    glm::dvec3 normal;
    glm::dvec3 point;
};

double along(const Ray& ray, const Plane& plane) {
    return glm::dot(plane.normal, plane.point - ray.origin) / glm::dot(plane.normal, ray.direction);
}

// Where an edge passes nearest to a place on the screen.
struct Passing {
    double distance_px;
    double along;  // How far the point of the edge is along the ray through the place.
};

class Place {
public:
    Place(const RayReference& rays, glm::dvec2 place, glm::dvec2 picture_size)
        : rays_(rays),
          place_(place),
          size_(picture_size),
          ray_(rays.camera_ray(place, picture_size)),
          surface_(rays.first_surface(ray_)) {}

    const Ray& ray() const { return ray_; }
    const std::optional<SurfacePoint>& surface() const { return surface_; }

    double along_ray(const glm::dvec3& world) const {
        return glm::dot(world - ray_.origin, ray_.direction) /
               glm::dot(ray_.direction, ray_.direction);
    }

    // Nothing where an end is not in front of the near plane.
    std::optional<Passing> passing(const glm::dvec3& a, const glm::dvec3& b) const {
        const std::optional<glm::dvec2> p = rays_.place_of(a, size_);
        const std::optional<glm::dvec2> q = rays_.place_of(b, size_);
        if (!p || !q) return std::nullopt;
        const glm::dvec2 span = *q - *p;
        const double t =
            span == glm::dvec2(0.0)
                ? 0.0
                : std::clamp(glm::dot(place_ - *p, span) / glm::dot(span, span), 0.0, 1.0);
        // What is linear on the screen is one over the distance, for perspective cameras.
        const double from = along_ray(a), to = along_ray(b);
        const double here = rays_.scene().camera.is_orthographic()
                                ? from + t * (to - from)
                                : 1.0 / ((1.0 - t) / from + t / to);
        return Passing{glm::distance(place_, *p + t * span), here};
    }

private:
    const RayReference& rays_;
    glm::dvec2 place_, size_;
    Ray ray_;
    std::optional<SurfacePoint> surface_;
};

// Whether a point in the plane of an edge and a light is where the edge keeps the light away, or hardly
// beside it.
bool is_behind_edge(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                    const Light& light) {
    constexpr double k_side_margin = 1e-3;
    // point - base = s * first + t * second
    const glm::dvec3 base = light.directional ? a : light.vector;
    const glm::dvec3 first = light.directional ? b - a : a - base;
    const glm::dvec3 second = light.directional ? -light.vector : b - base;
    const glm::dvec3 normal = glm::cross(first, second);
    const double s = glm::dot(glm::cross(point - base, second), normal) / glm::dot(normal, normal);
    const double t = glm::dot(glm::cross(first, point - base), normal) / glm::dot(normal, normal);
    if (light.directional)
        return s >= -k_side_margin && s <= 1.0 + k_side_margin && t >= -k_side_margin;
    return s >= -k_side_margin && t >= -k_side_margin && s + t >= 1.0 - k_side_margin;
}

// Whether both faces of an edge turn the same side to what lies in `direction` from it.
bool turn_alike(const RayReference& rays, std::size_t instance, std::span<const FaceId> faces,
                const glm::dvec3& direction) {
    return (glm::dot(rays.normal(instance, faces[0]), direction) > 0.0) ==
           (glm::dot(rays.normal(instance, faces[1]), direction) > 0.0);
}

template <typename Use>
bool any_edge(const Mesh& mesh, const Use& use) {
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        if (use(EdgeId{e}, e < regular_end)) return true;
    return false;
}

}  // namespace

bool is_on_silhouette(const RayReference& rays, glm::dvec2 place, glm::dvec2 picture_size) {
    const Place here(rays, place, picture_size);
    if (!here.surface()) return false;
    const double seen = here.along_ray(here.surface()->position);
    for (std::size_t i = 0; i < rays.scene().instances.size(); ++i) {
        const Mesh& mesh = rays.scene().instances[i].mesh();
        const bool found = any_edge(mesh, [&](EdgeId edge, bool is_regular) {
            const glm::dvec3& a = rays.vertex(i, mesh.edge(edge).vertices[0]);
            const glm::dvec3& b = rays.vertex(i, mesh.edge(edge).vertices[1]);
            if (is_regular && turn_alike(rays, i, mesh.faces_of(edge), rays.towards_viewer(a)))
                return false;
            const std::optional<Passing> passing = here.passing(a, b);
            return passing && passing->distance_px <= k_grid_px && passing->along < seen;
        });
        if (found) return true;
    }
    return false;
}

bool is_on_side(const RayReference& rays, glm::dvec2 place, glm::dvec2 picture_size) {
    const Place here(rays, place, picture_size);
    if (!here.surface()) return false;
    const Plane surface{rays.normal(here.surface()->instance, here.surface()->face),
                        here.surface()->position};
    const auto is_rounding = [&](const Plane& side) {
        const auto apart = [&](glm::dvec2 offset) {
            const Ray ray = rays.camera_ray(place + offset, picture_size);
            return along(ray, side) - along(ray, surface);
        };
        const double at_center = apart({0.0, 0.0});
        const double within_grid = std::abs(apart({k_grid_px, 0.0}) - at_center) +
                                   std::abs(apart({0.0, k_grid_px}) - at_center);
        return std::abs(at_center) <=
               within_grid + k_depth_share * std::abs(along(here.ray(), surface));
    };
    for (std::size_t i = 0; i < rays.scene().instances.size(); ++i) {
        if (!rays.scene().instances[i].casts_shadows) continue;
        const Mesh& mesh = rays.scene().instances[i].mesh();
        const bool found = any_edge(mesh, [&](EdgeId edge, bool is_regular) {
            const glm::dvec3& a = rays.vertex(i, mesh.edge(edge).vertices[0]);
            const glm::dvec3& b = rays.vertex(i, mesh.edge(edge).vertices[1]);
            return std::ranges::any_of(rays.scene().lights, [&](const Light& light) {
                const glm::dvec3 to_light = RayReference::towards(light, a);
                if (is_regular && turn_alike(rays, i, mesh.faces_of(edge), to_light)) return false;
                const Plane side{glm::cross(b - a, to_light), a};
                return is_rounding(side) &&
                       is_behind_edge(
                           here.ray().origin + along(here.ray(), side) * here.ray().direction, a, b,
                           light);
            });
        });
        if (found) return true;
    }
    return false;
}

}  // namespace rimline::tests
