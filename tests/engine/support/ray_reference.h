#pragma once

// What a picture should show, by rays: the second opinion on stencil volumes and on line visibility.
//
// Embree finds the triangles that a ray may hit; where along the ray each lies is computed again in
// double, from the triangle's own plane, so that a surface neither shades itself nor lets the light of
// its far side through. Nothing here is shared with the engine but the scene: the camera's rays follow
// from what engine/camera.h promises, not from its matrices.

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/embree.h"

namespace rimline::tests {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< Its length is the unit of distances along the ray.
};

/// Where a ray from the camera meets the scene.
struct SurfacePoint {
    std::size_t instance;
    FaceId face;
    glm::dvec3 position;
};

class RayReference {
public:
    /// `scene` and its meshes must outlive the reference and stay as they are. Leaves the thread's
    /// floating-point environment as it was.
    explicit RayReference(const Scene& scene);
    ~RayReference();
    RayReference(const RayReference&) = delete;
    RayReference& operator=(const RayReference&) = delete;

    /// The camera's ray through a place in a picture of this size: x to the right, y down, in pixels
    /// from the upper left corner. A pixel's center is at one half.
    Ray camera_ray(glm::dvec2 place, glm::dvec2 picture_size) const;

    /// Where a point of the world lies in a picture of this size; nothing where it is not in front of
    /// the near plane.
    std::optional<glm::dvec2> place_of(const glm::dvec3& world, glm::dvec2 picture_size) const;

    /// The first surface in front of the near plane.
    std::optional<SurfacePoint> first_surface(const Ray& camera_ray) const;

    /// How many of the scene's lights reach the side of the surface that `camera_ray` sees.
    std::size_t lights_at(const SurfacePoint& point, const Ray& camera_ray) const;

    using Ignored = std::function<bool(std::size_t instance, FaceId face)>;
    /// Whether anything but the ignored faces lies strictly between a point that the camera sees and
    /// the near plane.
    bool is_hidden(const glm::dvec3& world, const Ignored& ignored) const;

    /// A vertex of an instance, in the world.
    const glm::dvec3& vertex(std::size_t instance, VertexId vertex) const {
        return vertices_[instance][index(vertex)];
    }
    /// A point at the same depth, so many pixels to the right and down.
    glm::dvec3 displaced(const glm::dvec3& world, glm::dvec2 pixels, glm::dvec2 picture_size) const;

    const Scene& scene() const noexcept { return scene_; }
    /// Of a face, by its vertices' order: twice the area times the unit normal.
    glm::dvec3 normal(std::size_t instance, FaceId face) const;
    /// From a point towards the viewer; for perspective cameras as long as the way there.
    glm::dvec3 towards_viewer(const glm::dvec3& world) const;
    /// From a point towards a light; for those that are not directional as long as the way there.
    static glm::dvec3 towards(const Light& light, const glm::dvec3& world);

private:
    struct Query;
    static void keep_if_blocking(const RTCFilterFunctionNArguments* arguments);
    bool reaches(const SurfacePoint& point, const Ray& camera_ray, const Light& light) const;
    // The sine of the angle at which the light stands over the surface, on its front.
    double height(const SurfacePoint& point, const Light& light) const;
    bool is_blocked(Query& query, double end) const;
    double depth_of(const glm::dvec3& world) const;
    // The side of a pixel at the depth of a point.
    double pixel_size(const glm::dvec3& world, glm::dvec2 picture_size) const;

    const Scene& scene_;
    glm::dvec3 center_;
    double radius_;
    double near_ = 0.0;  // In front of the eye; of perspective cameras.
    glm::dvec3 right_, up_, back_;
    double half_height_;  // Of the picture, at unit distance for perspective cameras.
    std::vector<std::vector<glm::dvec3>> vertices_;
    RTCDevice device_ = nullptr;
    RTCScene rays_ = nullptr;
};

}  // namespace rimline::tests
