#include "tools/options/shadow_framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "engine/view_defaults.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "tools/options/picture_scene.h"
#include "tools/options/view_camera.h"

namespace rimline::tools {

namespace {

constexpr double k_max_tangent = 1.7320508;
constexpr std::uint32_t k_outline_directions = 128;

// Whether a place is before the camera, and within 60 degrees of its direction on both axes.
bool is_before(const glm::dmat3& axes, const glm::dvec3& eye, const glm::vec3& place) {
    const glm::dvec3 p = axes * (glm::dvec3(place) - eye);
    return std::max(std::abs(p.x), std::abs(p.y)) < -k_max_tangent * p.z;
}

// Where the shadows of positions fall.
class ShadowCaster {
public:
    ShadowCaster(const Mesh& mesh, std::span<const glm::vec3> positions,
                 const glm::dvec3& ground_up)
        : center_(mesh.center()),
          up_(glm::normalize(ground_up)),
          limit_(k_framed_shadow_radii * mesh.radius()),
          ground_(std::numeric_limits<double>::max()) {
        for (const glm::vec3& position : positions)
            ground_ = std::min(ground_, glm::dot(glm::dvec3(position) - center_, up_));
    }

    // From the center of the mesh; nothing if the light casts none, or it is farther away than the limit.
    std::optional<glm::dvec3> shadow(const Light& light, const glm::vec3& position) const {
        if (!light.casts_shadows) return std::nullopt;
        const glm::dvec3 away = glm::dvec3(position) - center_;
        const glm::dvec3 towards =
            light.directional ? glm::normalize(light.vector) : light.vector - center_ - away;
        const double rise = glm::dot(towards, up_);
        const double height = glm::dot(away, up_) - ground_;
        if (rise * limit_ <= 1e-9 * height * glm::length(towards)) {
            // What stands on the ground is its own shadow.
            return height <= 1e-9 * limit_ ? std::optional(away) : std::nullopt;
        }
        const glm::dvec3 shadow = away - (height / rise) * towards;
        return glm::length(shadow) <= limit_ ? std::optional(shadow) : std::nullopt;
    }

private:
    glm::dvec3 center_, up_;
    double limit_, ground_;
};

// Whether the ground, which is seen from above only, is not seen.
bool is_below_ground(const Camera& camera, const Mesh& mesh, const glm::dvec3& ground_up) {
    if (camera.is_orthographic()) return glm::dot(camera.eye - camera.target, ground_up) < 0.0;
    const double height = glm::dot(camera.eye, ground_up);
    return std::ranges::all_of(mesh.positions(), [&](const glm::vec3& p) {
        return height < glm::dot(glm::dvec3(p), ground_up);
    });
}

// Vertices of the mesh that are the farthest ones in some direction.
std::vector<glm::vec3> outline_positions(const Mesh& mesh) {
    std::vector<glm::vec3> outline;
    if (mesh.positions().empty()) return outline;
    for (std::uint32_t i = 0; i < k_outline_directions; ++i) {
        const glm::dvec3 spread = spread_direction(i, k_outline_directions);
        const glm::vec3 direction(spread.x, spread.z, spread.y);  // Around y, as most models stand.
        outline.push_back(*std::ranges::max_element(
            mesh.positions(), {}, [&](const glm::vec3& p) { return glm::dot(p, direction); }));
    }
    return outline;
}

struct FramedShot {
    Camera camera;
    std::vector<glm::vec3> places;
};
std::vector<FramedShot> framed_shots(std::span<const Shot> shots, const Mesh& mesh,
                                     const glm::dvec3& ground_up) {
    const std::vector<glm::vec3> outline = outline_positions(mesh);
    std::vector<FramedShot> framed;
    for (const Shot& shot : shots)
        framed.push_back({shot.camera, is_below_ground(shot.camera, mesh, ground_up)
                                           ? std::vector<glm::vec3>()
                                           : shadow_places(mesh, outline, shot.lights, ground_up)});
    return framed;
}

// Of half the vertical field of view that holds the places before the camera.
double tangent_of(const Camera& camera, std::span<const glm::vec3> places, double aspect) {
    const glm::dmat3 axes = camera_from_world(camera);
    double tangent = 0.0;
    for (const glm::vec3& place : places) {
        if (!is_before(axes, camera.eye, place)) continue;
        const glm::dvec3 p = axes * (glm::dvec3(place) - camera.eye);
        tangent = std::max({tangent, std::abs(p.x) / -p.z / aspect, std::abs(p.y) / -p.z});
    }
    return tangent;
}

}  // namespace

std::vector<glm::vec3> shadow_places(const Mesh& mesh, std::span<const glm::vec3> positions,
                                     std::span<const Light> lights, const glm::dvec3& ground_up) {
    std::vector<glm::vec3> places;
    const ShadowCaster caster(mesh, positions, ground_up);
    for (const Light& light : lights)
        for (const glm::vec3& position : positions)
            if (const std::optional<glm::dvec3> shadow = caster.shadow(light, position))
                places.emplace_back(mesh.center() + *shadow);
    return places;
}

double fade_of_ground(const Mesh& mesh, std::span<const Light> lights,
                      const glm::dvec3& ground_up) {
    const ShadowCaster caster(mesh, mesh.positions(), ground_up);
    const bool is_held = std::ranges::all_of(lights, [&](const Light& light) {
        return !light.casts_shadows ||
               std::ranges::all_of(mesh.positions(), [&](const glm::vec3& position) {
                   return caster.shadow(light, position).has_value();
               });
    });
    return (is_held ? k_ground_fade : k_framed_shadow_radii) * mesh.radius();
}

Camera frame_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                          const glm::dvec3& ground_up, double aspect) {
    if (is_below_ground(camera, mesh, ground_up)) return camera;
    std::vector<glm::vec3> points = shadow_places(mesh, mesh.positions(), lights, ground_up);
    double radius = mesh.radius();
    for (const glm::vec3& place : points)
        radius = std::max(radius, glm::distance(glm::dvec3(place), mesh.center()));
    points.insert(points.end(), mesh.positions().begin(), mesh.positions().end());
    const glm::dvec3 towards_viewer = camera.eye - camera.target;
    return rounded_to_float(fit_camera(camera, Subject(points, mesh.center(), radius, mesh.up()),
                                       towards_viewer, aspect));
}

void frame_ground(Scene& scene, const Mesh& mesh, const PictureOptions& options) {
    const bool is_chosen = !options.target && !(options.eye && options.fov_degrees);
    if (!scene.shadows || !is_chosen || scene.camera.is_orthographic()) return;
    const glm::dvec3 ground_up = rounded_to_float(ground_up_of(mesh, options));
    const double aspect = double(options.size.width) / options.size.height;
    const auto frame = options.eye ? zoom_with_shadows : frame_with_shadows;
    scene.camera = frame(scene.camera, mesh, scene.lights, ground_up, aspect);
}

Camera zoom_with_shadows(const Camera& camera, const Mesh& mesh, std::span<const Light> lights,
                         const glm::dvec3& ground_up, double aspect) {
    if (is_below_ground(camera, mesh, ground_up)) return camera;
    const glm::dmat3 axes = camera_from_world(camera);
    std::vector<glm::vec3> points = shadow_places(mesh, mesh.positions(), lights, ground_up);
    std::erase_if(points,
                  [&](const glm::vec3& place) { return !is_before(axes, camera.eye, place); });
    points.insert(points.end(), mesh.positions().begin(), mesh.positions().end());
    const std::optional<FittedLens> lens =
        fit_lens(points, mesh.center(), camera.eye, camera.up, aspect);
    if (!lens) return camera;
    Camera zoomed = camera;
    zoomed.target = lens->target;
    zoomed.up = lens->up;
    zoomed.fov_y_deg = field_of_view_deg(*lens);
    return rounded_to_float(zoomed);
}

double tangent_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                           const glm::dvec3& ground_up, double aspect) {
    double tangent = 0.0;
    for (const FramedShot& shot : framed_shots(shots, mesh, ground_up))
        tangent = std::max(tangent, tangent_of(shot.camera, shot.places, aspect));
    return k_view_margin * tangent;
}

double distance_for_shadows(std::span<const Shot> shots, const Mesh& mesh,
                            const glm::dvec3& ground_up, double aspect) {
    constexpr double k_max_factor = 4.0;
    const std::vector<FramedShot> framed = framed_shots(shots, mesh, ground_up);
    const auto holds = [&](double factor) {
        return std::ranges::all_of(framed, [&](const FramedShot& shot) {
            Camera camera = shot.camera;
            camera.eye = camera.target + factor * (camera.eye - camera.target);
            const double tangent = std::tan(0.5 * glm::radians(camera.fov_y_deg));
            return k_view_margin * tangent_of(camera, shot.places, aspect) <= tangent;
        });
    };
    if (holds(1.0)) return 1.0;
    double low = 1.0, high = k_max_factor;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace rimline::tools
