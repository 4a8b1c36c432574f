#pragma once

// What is up for a camera that goes round a closed path and keeps looking at one place.
//
// An upright camera turns about its line of sight by half a turn in no time where it passes the up axis.
// This one may lean there. With s the way that the line of sight has turned, φ the roll and ψ that of an
// upright camera, both against a frame carried along without any roll of its own, θ the angle between
// line of sight and axis:
//
//     least of  ∫ L² φ'² + sin⁴θ (φ - ψ)²  ds        around the path
//
// Where φ' is even, as on any circle about the axis, the camera stays upright. Over the
// axis itself, with L = 0.15, it rolls at most twice as fast as the line of sight turns, and leans by less
// than 5 degrees where that is 60 degrees from the axis.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

/// For each eye a unit vector perpendicular to its line of sight; as smooth around the end of the list as
/// within. `lean_rad` is L. No eye at the target, consecutive ones (the last and the first too) not on
/// opposite sides of it, up not zero (RIMLINE_CHECK). Where nothing is upright, as all eyes are on the
/// axis, any frame without roll. O(eyes).
std::vector<glm::dvec3> steady_ups(std::span<const glm::dvec3> eyes, const glm::dvec3& target,
                                   const glm::dvec3& up, double lean_rad = 0.15);

}  // namespace rimline
