#pragma once

// What there is to draw: instances of meshes, lights, a camera and a style.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/camera.h"
#include "engine/deformation.h"
#include "engine/shadow_choice.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

// Cameras and lights must lie within k_max_coordinate of the origin, in the coordinates of every
// instance.

/// What an instance is made of. Colors in linear light.
struct Material {
    glm::vec3 color{1.0f};
    /// Of its lines, and of the strokes that shade it in Style::hatch; the palette's ink where there is
    /// none. Each color of lines beyond the first is one draw over the picture more.
    std::optional<glm::vec3> line_color;
};

/// A mesh somewhere in the world: world = rotation * object + translation. The octree and its mesh must
/// outlive every renderer that has drawn them.
struct SceneInstance {
    const HoughOctree* octree = nullptr;  ///< Null for a mesh that deforms.
    std::string name = "a model";         ///< For messages: that of its file, say.
    /// A mesh whose vertices move, instead of an octree's: its silhouettes are found on the GPU, and it
    /// must outlive the renderer likewise.
    const Mesh* deforming = nullptr;
    Deformation deformation;   ///< Of `deforming`, in this frame.
    glm::dmat3 rotation{1.0};  ///< Orthonormal, without reflection.
    glm::dvec3 translation{0.0};
    Material material;
    bool has_lines = true;
    bool casts_shadows = true;
    /// As is_solid(mesh()) says, which takes about a microsecond a face: worth asking where more
    /// than a few frames are drawn. Backs of faces are then left out where the camera is outside
    /// the bounds, half of the surfaces; the picture stays the same but for single pixels of
    /// silhouettes, which rounding gave a back. Of a mesh that deforms it says nothing.
    bool is_solid = false;
    /// Over 0: fades into the background towards this distance from fade_center (world), as a ground
    /// without an end does. Backs of its faces are left out: who looks from below sees through it.
    double fade_radius = 0.0;
    glm::dvec3 fade_center{0.0};

    const Mesh& mesh() const noexcept { return deforming ? *deforming : octree->mesh(); }
    /// In the instance's own coordinates. O(1).
    BoundingSphere bounds() const {
        if (deforming) return bounding_sphere(*deforming, deformation);
        return {octree->mesh().center(), octree->mesh().radius()};
    }
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
    blueprint,  ///< Fine light lines on blue paper with a grid; surfaces are hardly there.
    hatch,  ///< Strokes of the lines' color in which light and shadow lie: the darker, the denser.
};

/// Colors in linear light.
struct Palette {
    glm::vec3 background{1.0f};
    glm::vec3 ink{0.0f};  ///< Of lines and strokes where the material has no color for them.
    /// What is left of a surface's color in shadow. Style::hatch leaves that much of it between its
    /// strokes, on average over the three channels.
    glm::vec3 shade{0.5f};
    glm::vec3 grid{0.0f};        ///< Lines over paper and surfaces, under the ink ...
    float grid_strength = 0.0f;  ///< ... where over 0, up to 1.
};

struct Scene {
    std::vector<SceneInstance> instances;
    std::vector<Light> lights;  ///< Each adds an equal share of the light.
    Camera camera;
    /// Whose silhouettes are drawn as lines, where not the camera's own: they can be looked at from
    /// elsewhere then (thesis, Figure 1.2). Only where it stands counts, or looks if it is orthographic.
    std::optional<Camera> silhouette_camera;
    Style style = Style::ink;
    Palette palette;
    bool shadows = true;
    /// How volumes are drawn; pictures are the same (shadow_choice.h).
    ShadowMethod shadow_method = ShadowMethod::automatic;
    ShadowForm shadow_form = ShadowForm::automatic;
    bool lines = true;
    float line_width_px = 2.5f;
    float hidden_line_strength =
        0.0f;  ///< 0 leaves hidden lines out, 1 draws them as strong as others.
    /// Hidden lines are drawn so many pixels, and left out the next so many; without a gap they are
    /// whole. Neither may be negative.
    float dash_px = 7.0f;
    float dash_gap_px = 4.5f;
    /// Over 0: edges that bend by at least this are lines too, where seen. No edge that bends by less
    /// than 10 degrees is one (k_min_crease_rad).
    float crease_angle_deg = 0.0f;
    float hatch_spacing_px = 5.0f;  ///< Between strokes of Style::hatch; over 0.
};

/// A sphere around all instances.
struct SceneBounds {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};
SceneBounds bounds_of(const Scene& scene);

}  // namespace rimline
