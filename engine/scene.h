#pragma once

// What there is to draw: instances of meshes, lights, a camera and a style.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/camera.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

// Cameras and lights must lie within k_max_coordinate of the origin, in the coordinates of every
// instance.

/// A mesh somewhere in the world: world = rotation * object + translation. The octree and its mesh must
/// outlive every renderer that has drawn them.
struct SceneInstance {
    const HoughOctree* octree = nullptr;
    glm::dmat3 rotation{1.0};  ///< Orthonormal, without reflection.
    glm::dvec3 translation{0.0};
    glm::vec3 color{1.0f};  ///< Linear light.
    bool has_lines = true;
    bool casts_shadows = true;
    /// Over 0: fades into the background towards this distance from fade_center (world), as a ground
    /// without an end does.
    double fade_radius = 0.0;
    glm::dvec3 fade_center{0.0};
};

struct Light {
    /// A position, or a direction from the scene towards the light.
    glm::dvec3 vector{0.0, 1.0, 0.0};
    bool directional = true;
};

enum class Style : std::uint32_t {
    ink,   ///< Paper, lines, and flat shadow.
    toon,  ///< Color in two tones.
    mask,  ///< White where light arrives by the stencil alone, black where not: to see and to test.
};

/// Colors in linear light.
struct Palette {
    glm::vec3 background{1.0f};
    glm::vec3 ink{0.0f};
    glm::vec3 shade{0.5f};  ///< What is left of a surface's color in shadow.
};

struct Scene {
    std::vector<SceneInstance> instances;
    std::vector<Light> lights;  ///< Each adds an equal share of the light.
    Camera camera;
    Style style = Style::ink;
    Palette palette;
    bool shadows = true;
    bool lines = true;
    float line_width_px = 2.5f;
    float hidden_line_strength =
        0.0f;  ///< 0 leaves hidden lines out, 1 draws them as strong as others.
};

/// A sphere around all instances.
struct SceneBounds {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};
SceneBounds bounds_of(const Scene& scene);

}  // namespace rimline
