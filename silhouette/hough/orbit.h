#pragma once

// The circular path of a camera or a light around a model: about a center, in the plane perpendicular to an
// up axis.
//
//     p(a) = center + radius * (first * cos a + second * sin a),    second = up x first
//
// It starts on the first of the x, y, z axes that lies in that plane. If none does, it starts on the
// projection of the first of x, y that is not nearly parallel to the up axis. It turns counterclockwise as
// seen from the tip of `up`. It is computed in double and rounded once to the floats of a point.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "silhouette/error.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

class Orbit {
public:
    /// `up` need not be a unit vector but must have a direction.
    Orbit(const glm::dvec3& center, const glm::dvec3& up, double radius) noexcept
        : center_(center), radius_(radius) {
        const double length = glm::length(up);
        RIMLINE_CHECK(length > 0.0 && std::isfinite(length));
        const glm::dvec3 axis = up / length;
        first_ = start_in_plane_of(axis);
        second_ = glm::cross(axis, first_);
    }

    glm::dvec3 position(double angle_rad) const noexcept {
        return center_ + radius_ * (std::cos(angle_rad) * first_ + std::sin(angle_rad) * second_);
    }
    HomogeneousPoint viewpoint(double angle_rad) const noexcept {
        return HomogeneousPoint::viewpoint(glm::vec3(position(angle_rad)));
    }

private:
    static glm::dvec3 start_in_plane_of(const glm::dvec3& axis) noexcept {
        for (int i = 0; i < 3; ++i)
            if (axis[i] == 0.0) return unit(i);
        const int i = std::abs(axis.x) < 0.999 ? 0 : 1;
        return glm::normalize(unit(i) - axis[i] * axis);
    }
    static glm::dvec3 unit(int i) noexcept {
        glm::dvec3 e(0.0);
        e[i] = 1.0;
        return e;
    }

    glm::dvec3 center_;
    double radius_;
    glm::dvec3 first_{}, second_{};
};

}  // namespace rimline
