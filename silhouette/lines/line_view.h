#pragma once

// The camera of a line drawing.
//
// Picture coordinates have x to the right and y upwards, with the target at (0, 0). For a perspective camera
// they are tangents of angles, for an orthographic one the model's units.
//
// Lines are decided from a point beside the eye, about a thousandth of a pixel away (k_shift). In a view along
// an axis of a machine part many things coincide in the picture, and their order would not be defined. From
// the point beside it is. The silhouette must be found from that point too: point(). Its coordinates are floats: an eye
// at more than a few of its distances from the origin is shifted by four steps of a float, up to a fortieth of a pixel.
//
// That is true of things about as far away as the center of the mesh. The shift is a share of that distance, at least
// of the mesh's radius (drawn_distance()), so nearer things move farther in the picture, by shift() over their own
// distance: in a scene of radius 10 km, an eye one meter before a wall sees it from a point that is about a centimeter
// aside. What lies within that of each other there may be drawn in the wrong order, or as one line.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class LineView {
public:
    /// The distance between the eye and point(), as a share of the distance from the eye to what is drawn.
    static constexpr double k_shift = 0x1p-20;

    /// A perspective camera. `up` may have any length; where it is parallel to the view or zero, another axis takes
    /// its place. `eye` and `target` must differ, and be valid points (HomogeneousPoint::is_valid()). The shift is a
    /// share of `distance`, about that from the eye to what is drawn (drawn_distance()), not zero; without it, of that
    /// to the target.
    static LineView perspective(const glm::dvec3& eye, const glm::dvec3& target,
                                const glm::dvec3& up, std::optional<double> distance = {});
    /// An orthographic camera that looks from `eye` to `target`. The distance does not matter.
    static LineView orthographic(const glm::dvec3& eye, const glm::dvec3& target,
                                 const glm::dvec3& up);

    /// The silhouette point: a viewpoint, or the direction towards the viewer.
    const HomogeneousPoint& point() const noexcept { return point_; }
    bool is_orthographic() const noexcept { return point_.is_direction(); }

    struct Projected {
        glm::dvec2 position;
        double depth;  ///< Along the view: from the eye, or from the target where orthographic.
    };
    /// As the camera shows it. A perspective camera shows only what has a depth greater than 0.
    Projected project(const glm::dvec3& point) const noexcept;
    /// The inverse of project().
    glm::dvec3 unproject(const Projected& projected) const noexcept;
    const glm::dvec3& eye() const noexcept { return eye_; }
    /// The distance between eye and point(), or of an orthographic camera the tangent of the angle between their
    /// directions, but for rounding.
    double shift() const noexcept { return shift_; }
    /// project() from point(). In a perspective picture a thing at a distance d moves by about shift() / d.
    Projected project_from_point(const glm::dvec3& point) const noexcept;

    // The axes of the camera, of length 1.
    const glm::dvec3& right() const noexcept { return right_; }
    const glm::dvec3& up() const noexcept { return up_; }
    const glm::dvec3& forward() const noexcept { return forward_; }

private:
    LineView(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

    glm::dvec3 eye_, target_;
    double shift_ = k_shift;
    glm::dvec3 right_, up_, forward_;
    HomogeneousPoint point_{};
    // Of project_from_point(). An orthographic projection goes exactly along point_, so it is turned a little.
    glm::dvec3 point_right_{}, point_up_{}, point_forward_{};
};

/// The distance from an eye to the center of a mesh, at least its radius; 1 for a mesh of one point.
double drawn_distance(const Mesh& mesh, const glm::dvec3& eye);

}  // namespace rimline
