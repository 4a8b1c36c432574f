#pragma once

// Published measures for the choice of views, at the same candidates. `rimline bench views` compares them
// with the votes of planes.
//
//   area        pixels that the mesh covers: projected area (Plemenos, Benayada 1996)
//   entropy     -Σ (a/A) log2(a/A), a: pixels of each visible face and of the background, A: all pixels
//               (Vázquez et al. 2001)
//   silhouette  pixels of the silhouette's visible lines, borders included (visible_ratio.h)
//
// Candidates are distributed evenly over a sphere between the radii of the shell in which votes are summed.
// All pictures have the same field of view. Entropy depends on faces as long as they are larger than a
// pixel; for finer meshes it becomes a measure of area.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/measure/visible_ratio.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// A Fibonacci lattice of unit vectors, about 3.5 / √count radians apart.
std::vector<glm::dvec3> even_directions(std::uint32_t count);

struct ViewMeasures {
    std::vector<glm::dvec3> eyes;                   ///< Candidates.
    std::vector<double> area, entropy, silhouette;  ///< One a candidate.
    /// One bit for each face and candidate: whether the center of the face is seen.
    std::vector<std::vector<bool>> seen;
};

/// Computes `seen` only with `with_seen`. Uses all threads. The context can cancel it.
ViewMeasures measure_views(const Mesh& mesh, VisibleRatioPass& pass, std::uint32_t candidates,
                           bool with_seen, const Context& context);

/// One bit a face: whether its center is seen from `eye`, which must be outside the mesh's sphere.
std::vector<bool> faces_seen(const Mesh& mesh, const glm::dvec3& eye);

/// The numbers of `count` candidates: the best of those that are best within 20 degrees; where these are
/// too few, then the best that are 20 degrees from all of them.
std::vector<std::size_t> best_apart(const Mesh& mesh, const std::vector<glm::dvec3>& eyes,
                                    const std::vector<double>& measure, std::size_t count);

/// Chooses greedily the candidate that shows most faces not seen from those before it: a reference.
std::vector<std::size_t> greedy_coverage(const ViewMeasures& measures, std::size_t count);

}  // namespace rimline::tools
