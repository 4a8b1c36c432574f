#pragma once

// A scene: instances of meshes, lights, a camera and a style.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/camera.h"
#include "engine/deformation.h"
#include "engine/shadow_choice.h"

namespace rimline {

class HoughOctree;
class Mesh;
struct PictureLines;

// Cameras and lights must lie within k_max_coordinate of the origin, in the coordinates of every
// instance. Renderer stops the program where a number is outside of the limits that are said here.

/// The colors of an instance, in linear light.
struct Material {
    /// Of its surfaces.
    glm::vec3 color{1.0f};
    /// Whether faces have the colors of the mesh (silhouette/mesh/face_materials.h) instead of `color`, where
    /// the mesh has some. Only in styles that show colors: ink, toon and hatch.
    bool shows_mesh_colors = true;
    /// Color of its lines, and of the strokes that shade it in Style::hatch; default: the palette's ink.
    /// Each further color of lines in a scene costs one draw over the whole picture.
    std::optional<glm::vec3> line_color;
    /// Whether each line, and each stroke in Style::hatch, has a dark shade of the material of its face instead
    /// (silhouette/mesh/material_inks.h), or a pale one where the palette's ink is lighter than its background.
    /// In the styles that show colors. Lines of faces without a material have the color above, and all lines by
    /// a path that tests every edge (line_path.h). At most k_max_material_inks colors. Not for
    /// SceneInstance::picture_lines, which have colors of their own.
    bool lines_in_mesh_colors = false;
};

/// A mesh placed in the world: world = rotation * (scale * object) + translation. The octree and its mesh must live
/// until a renderer that has drawn them prepares or draws a scene without them, or is destroyed; afterwards it does
/// not read them, and others may have their addresses.
struct SceneInstance {
    const HoughOctree* octree = nullptr;  ///< Null for a mesh that deforms.
    std::string name = "a model";         ///< For messages; the name of its file, for example.
    /// A mesh whose vertices move, instead of the octree's. Its silhouettes are found on the GPU. It must
    /// live as long as an octree. Drawing it throws Error{no_device} on a device without
    /// DeviceFacts::round_to_nearest_float32.
    const Mesh* deforming = nullptr;
    Deformation deformation;  ///< Of `deforming`, in this frame.
    /// Of `deforming`. False: its shadow is right where at most 254 of its triangles are in a row from a light,
    /// which is assumed. True: it is right whatever is in a row, as that of a mesh that does not deform. Then
    /// the CPU computes the positions of a wave, and in each frame, for each light, face bits and a bound:
    /// about 50 ns a face.
    bool has_deep_shadows = false;
    glm::dmat3 rotation{1.0};  ///< Without scale and reflection (is_rotation(), camera.h).
    double scale = 1.0;        ///< The same along all axes; greater than 0.
    glm::dvec3 translation{0.0};
    Material material;
    /// False: its color is not drawn, because another renderer has drawn it, or nobody does. It hides what lies
    /// behind it all the same, and shadows on it are drawn: black, with the part of the light that they take as
    /// opacity (the mean of 1 - Palette::shade); in Style::hatch as strokes. A picture with such an instance has
    /// no grid.
    bool has_surfaces = true;
    bool has_lines = true;
    /// Lines to draw instead of its silhouette, borders and creases (picture_lines.h). Nothing hides them: where
    /// other instances may lie before this one, the caller must know what they hide. Only what is on the
    /// instance in the picture, or within eight pixels of it, is sure to be drawn. Need not outlive the call.
    const PictureLines* picture_lines = nullptr;
    bool casts_shadows = true;
    /// The result of is_solid(mesh()), which takes 0.2 microseconds a face and is worth it for more than a few frames.
    /// If true, back faces are not drawn while the camera is outside the bounds: half of the surfaces. The picture
    /// differs only in single pixels of silhouettes that showed a back by rounding. On a CPU device the vertices of
    /// these faces are not computed either, of 5.6 million faces in all instances together. Ignored for a mesh that
    /// deforms.
    bool is_solid = false;
    /// Greater than 0: fades into the background towards this distance from fade_center (world), like a ground
    /// without an end. Back faces are not drawn, so a viewer below the ground sees through it. It is as light
    /// as the background wherever no shadow falls, whatever the angle of the light, and lights without shadows
    /// do not count: in shadow from all others it is in full shadow.
    double fade_radius = 0.0;
    glm::dvec3 fade_center{0.0};

    const Mesh& mesh() const noexcept;
    /// In the instance's own coordinates. O(1).
    BoundingSphere bounds() const;
};

/// Where a point of an instance's own coordinates is.
glm::dvec3 point_in_world(const SceneInstance& instance, const glm::dvec3& point);

struct Light {
    /// A position, or a direction from the scene towards the light: of any length but 0.
    glm::dvec3 vector{0.0, 1.0, 0.0};
    bool directional = true;
    /// Its share in the light of a fully lit surface, greater than 0. Not set: 1 by the number of lights. If
    /// the shares add up to more than 1, surfaces may become lighter than their color.
    std::optional<float> share;
    /// False: it lights all that turns towards it, as a large soft light does.
    bool casts_shadows = true;
    /// True: it fills the shadows that the other lights leave, and does not add to their light. Where it shines, a
    /// surface is at least as light as if only `share` of its full light arrived, at most 1. In Style::hatch its
    /// strokes are thinner there; on surfaces in the colors of a mesh only if strokes have colors of materials
    /// (Material::lines_in_mesh_colors). Casts no shadows, and comes after all lights that do not fill.
    bool fills = false;

    bool operator==(const Light&) const = default;
};

enum class Style : std::uint32_t {
    ink,   ///< Paper, lines, and flat shadow.
    toon,  ///< Color in two tones.
    mask,  ///< The stencil's shadow alone: white where light arrives, black elsewhere. For tests.
    blueprint,  ///< Fine light lines on blue paper with a grid; surfaces are faint.
    hatch,      ///< Light and shadow as strokes in the lines' color: the darker, the denser.
};

/// Whether surfaces have colors of their own in this style.
constexpr bool shows_colors(Style style) noexcept {
    return style == Style::ink || style == Style::toon || style == Style::hatch;
}

/// Colors in linear light.
struct Palette {
    glm::vec3 background{1.0f};
    glm::vec3 ink{0.0f};  ///< Of lines and strokes whose material has no line_color.
    /// Factor of a surface's color in shadow. Style::hatch leaves this part of the surface between its
    /// strokes (the mean of the three channels).
    glm::vec3 shade{0.5f};
    glm::vec3 grid{0.0f};        ///< Of grid lines over paper and surfaces, under the ink.
    float grid_strength = 0.0f;  ///< Opacity of the grid, 0 (no grid) to 1.

    /// Whether lines are lighter than the background.
    bool has_light_ink() const noexcept {
        return ink.x + ink.y + ink.z > background.x + background.y + background.z;
    }
};

struct Scene {
    std::vector<SceneInstance> instances;
    std::vector<Light> lights;
    Camera camera;
    /// The camera whose silhouettes are drawn as lines; default: `camera`. Another one freezes them, to be
    /// viewed from elsewhere (thesis, Figure 1.2). Only its eye counts, or its direction if orthographic.
    std::optional<Camera> silhouette_camera;
    Style style = Style::ink;
    Palette palette;
    /// False: Renderer::render() and submit() draw a picture with straight alpha, and no grid: 0 where nothing is,
    /// 1 where surfaces and lines are, between at their edges. A frame that is recorded has what its target says
    /// (PictureUse).
    bool has_background = true;
    bool shadows = true;
    /// How volumes are drawn; does not change the picture (shadow_choice.h).
    ShadowMethod shadow_method = ShadowMethod::automatic;
    ShadowForm shadow_form = ShadowForm::automatic;
    bool lines = true;
    float line_width_px = 2.5f;  ///< Not negative.
    float hidden_line_strength =
        0.0f;  ///< Opacity of hidden lines: 0 omits them, 1 draws them like visible lines.
    /// Lengths of the dashes of hidden lines and of the gaps between them. A gap of 0: solid lines. Neither
    /// may be negative.
    float dash_px = 7.0f;
    float dash_gap_px = 4.5f;
    /// Greater than 0: visible edges that bend by at least this angle are drawn as lines too. Edges that
    /// bend by less than 10 degrees (k_min_crease_rad) never are.
    float crease_angle_deg = 0.0f;
    /// Of these edges, only those that bend by 30 degrees and stand out (silhouette/mesh/clear_creases.h).
    bool only_clear_creases = false;
    float hatch_spacing_px = 5.0f;  ///< Between strokes of Style::hatch; greater than 0.
    /// Meshes of these that were drawn stay on the device, though no instance shows them now: for a scene that
    /// alternates with another. They must live as those of instances.
    std::vector<const HoughOctree*> kept;
};

/// A sphere around all instances.
struct SceneBounds {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};
SceneBounds bounds_of(const Scene& scene);

}  // namespace rimline
