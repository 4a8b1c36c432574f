#pragma once

// The up vectors of a camera that moves along a closed path and looks at a fixed target.
//
// An upright camera rolls by half a turn at once when it passes the up axis. This camera may lean there.
// Let s be the angle that the line of sight has turned, φ the roll, ψ the roll of an upright camera, and θ
// the angle between line of sight and axis. Both rolls are relative to a frame transported without roll.
// φ is
//
//     the minimum of  ∫ L² φ'² + sin⁴θ (φ - ψ)²  ds        around the path
//
// If φ' is constant, as on any circle about the axis, the camera stays upright. If it passes over the
// axis, with L = 0.15, it rolls at most twice as fast as the line of sight turns. It then leans by less
// than 5 degrees where the line of sight is 60 degrees from the axis.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

/// For each eye, a unit vector perpendicular to its line of sight. The result is smooth also from the last
/// to the first eye. `lean_rad` is L. No eye may be at the target, consecutive eyes (also the last and the
/// first) must not be on opposite sides of it, and `up` must not be zero (RIMLINE_CHECK). If all eyes are
/// on the axis, upright is undefined, and the result is a frame without roll. O(eyes).
std::vector<glm::dvec3> steady_ups(std::span<const glm::dvec3> eyes, const glm::dvec3& target,
                                   const glm::dvec3& up, double lean_rad = 0.15);

}  // namespace rimline
