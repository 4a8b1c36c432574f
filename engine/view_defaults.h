#pragma once

// A camera and a light for who gives none, and what the styles look like.

#include <span>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// What a camera is to show: positions within a sphere, a mesh's or a cloud's. Looks at them while it lives.
struct Subject {
    Subject(const Mesh& mesh)
        : Subject(mesh.positions(), mesh.center(), mesh.radius(), mesh.up()) {}
    Subject(std::span<const glm::vec3> seen, const glm::dvec3& middle, double reach, UpAxis axis)
        : positions(seen), center(middle), radius(reach), up(axis) {}

    std::span<const glm::vec3> positions;
    glm::dvec3 center;
    double radius;
    UpAxis up;
};

/// Places a camera in the direction `towards_viewer` from the subject; `camera` brings field of view or
/// height, and up. A perspective camera's target and distance are chosen so that every position lies
/// inside the picture with a margin of 6%; an orthographic camera looks at the subject's center.
/// O(positions).
Camera fit_camera(Camera camera, const Subject& subject, const glm::dvec3& towards_viewer,
                  double aspect);

/// The same for a perspective camera that stays where it is, outside the sphere around the mesh: turned and
/// given a field of view, over 1°, so that every used vertex lies inside the picture with that margin.
/// O(vertices).
Camera zoom_camera(Camera camera, const Mesh& mesh, double aspect);

/// The default three-quarter view: from the front, the right and above, for this up axis.
glm::dvec3 default_view_direction(const glm::dvec3& up);

/// A sun from over the viewer's left shoulder.
Light default_sun(const Camera& camera);

/// A ground under a mesh: two triangles, wide enough to fade out (SceneInstance::fade_radius) before
/// they end.
MeshSource make_ground(const Mesh& mesh, const glm::dvec3& up, double radius);

/// How a style is drawn where nobody says otherwise.
struct StyleDefaults {
    glm::vec3 background;  ///< Linear light.
    float line_width_px;
    float crease_angle_deg;      ///< 0: creases are no lines.
    float hidden_line_strength;  ///< Where hidden lines are drawn.
};
StyleDefaults style_defaults(Style style);

Palette default_palette(Style style, const glm::vec3& background);
glm::vec3 default_surface_color(Style style, const glm::vec3& background);

}  // namespace rimline
