#pragma once

// Defaults: a camera, a light, a ground, and the look of the styles. A direction that is 0, or an aspect that is not
// greater than 0, stops the program.

#include <span>

#include "engine/scene.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// What a camera shows: positions of a mesh or a cloud, within a sphere. Holds a span: the positions must
/// outlive it.
struct Subject {
    Subject(const Mesh& mesh)
        : Subject(mesh.positions(), mesh.center(), mesh.radius(), mesh.up()) {}
    Subject(std::span<const glm::vec3> points, const glm::dvec3& sphere_center,
            double sphere_radius, UpAxis axis)
        : positions(points), center(sphere_center), radius(sphere_radius), up(axis) {}

    std::span<const glm::vec3> positions;
    glm::dvec3 center;
    double radius;
    UpAxis up;
};

/// Places a camera in the direction `towards_viewer` from the subject. `camera` gives the field of view or
/// the height, and up. A perspective camera's target and distance are chosen so that every position lies
/// inside the picture with a margin of 6%; an orthographic camera looks at the subject's center.
/// O(positions).
Camera fit_camera(Camera camera, const Subject& subject, const glm::dvec3& towards_viewer,
                  double aspect);

/// Turns a perspective camera, which keeps its eye, and sets its field of view so that every used vertex
/// lies inside the picture with a margin of 6%. The field of view is at least 1 degree. The eye must lie
/// outside the sphere around the mesh. O(vertices).
Camera zoom_camera(Camera camera, const Mesh& mesh, double aspect);

/// The default three-quarter view for this up axis: from the front, the right and above.
glm::dvec3 default_view_direction(const glm::dvec3& up);

/// A sun above and to the left of the viewer.
Light default_sun(const Camera& camera);

/// A ground under a mesh: a square of two triangles with corners `radius` away along each axis, so that it
/// can fade out (SceneInstance::fade_radius) before it ends.
MeshSource make_ground(const Mesh& mesh, const glm::dvec3& up, double radius);

/// The defaults of a style.
struct StyleDefaults {
    glm::vec3 background;  ///< Linear light.
    float line_width_px;
    float crease_angle_deg;      ///< Of creases that stand out. 0: creases are not drawn.
    float hidden_line_strength;  ///< If hidden lines are drawn.
};
StyleDefaults style_defaults(Style style);

Palette default_palette(Style style, const glm::vec3& background);
glm::vec3 default_surface_color(Style style, const glm::vec3& background);

}  // namespace rimline
