#pragma once

// The axes of a ground under a model, and the directions in which drawings show it. For y up, the viewer stands
// in front at +z.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rimline {

/// A right-handed pair perpendicular to `up`, of length 1. `first` points to the right of a viewer in front, and
/// `second` away from that viewer.
struct GroundAxes {
    glm::dvec3 first, second;
};

/// `first` is the first coordinate axis in the plane of the ground. `up` must not be zero.
inline GroundAxes ground_axes(const glm::dvec3& up) {
    const glm::dvec3 n = glm::normalize(up);
    const glm::dvec3 x(1, 0, 0);
    const glm::dvec3 seed = std::abs(n.x) < 0.9 ? x : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(seed - n * glm::dot(seed, n));
    return {first, glm::cross(n, first)};
}

/// The default three-quarter view: towards a viewer in front, to the right and above. Of length 1.
inline glm::dvec3 three_quarter_direction(const glm::dvec3& up) {
    const auto [first, second] = ground_axes(up);
    return glm::normalize(0.55 * first - 1.0 * second + 0.45 * glm::normalize(up));
}

/// The cosine of the angle between a direction of length 1 and the nearer of the two three-quarter views of what faces
/// `front`, which has length 1 and is perpendicular to `up`; a little more for the right one, so that it is the nearer
/// one where both are alike.
inline double three_quarter_likeness(const glm::dvec3& direction, const glm::dvec3& up,
                                     const glm::dvec3& front) {
    const glm::dvec3 usual = three_quarter_direction(up);
    const auto [first, second] = ground_axes(up);
    // Turned around `up`, by what turns the usual front to this one.
    const glm::dvec3 right = glm::dot(front, -second) * first + glm::dot(front, first) * second;
    const auto view = [&](double side) {
        return side * glm::dot(usual, first) * right + glm::dot(usual, -second) * front +
               glm::dot(usual, glm::normalize(up)) * glm::normalize(up);
    };
    return std::max(glm::dot(direction, view(1.0)) + 1e-3, glm::dot(direction, view(-1.0)));
}
/// The same of what faces the usual front.
inline double three_quarter_likeness(const glm::dvec3& direction, const glm::dvec3& up) {
    return three_quarter_likeness(direction, up, -ground_axes(up).second);
}

}  // namespace rimline
