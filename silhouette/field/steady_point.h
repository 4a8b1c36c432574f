#pragma once

// A point of interest that a little noise does not move.
//
// Weighed scores are flat at their peaks, within a few percent over ten and more degrees, and where a mesh is seen
// along its flat faces they have spikes that noise of a thousandth of its radius removes. So the point is not the
// highest one: of several peaks, that with the highest mean over the directions near it is chosen, and of its plateau
// the middle.

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

/// The scores of points, in their order.
using ScorePoints = std::function<std::vector<double>(std::span<const glm::dvec3>)>;

/// The mean of the scores of a point, not the center, and of six around it, ten degrees away at its distance.
double mean_score_near(const glm::dvec3& point, const ScorePoints& score);

/// The mean of the directions within 20 degrees of a point, each by how far its score is above 0.95 of the highest
/// there; again from there until it rests, or would have less than 0.8 of it. At the distance of `point`, which is not
/// the center. 20 scores each time, at most ten times.
///
/// Chosen on the eight models of the tests that are not flat, with noise of 0.1% of the radius and with a quarter of
/// the faces: as the highest point the first view moves by 10 to 130 degrees on five of them, so by 9.5 degrees at
/// most. Within 30 degrees and above 0.92 fandisk moved by 14.
/// Later points are not chosen from the same plateau, is_on_plateau().
glm::dvec3 middle_of_plateau(const glm::dvec3& point, const ScorePoints& score);

/// Whether the direction of a point is within 20 degrees of that of the middle of a plateau.
bool is_on_plateau(const glm::dvec3& point, const glm::dvec3& middle);

}  // namespace rimline
