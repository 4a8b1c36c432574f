#pragma once

// What others measure of a view, at the same candidates, to choose views by: `rimline bench views` sets them
// beside the votes of planes.
//
//   area        pixels that the mesh covers: projected area (Plemenos, Benayada 1996)
//   entropy     -Σ (a/A) log2(a/A) over the pixels a of each face seen and of the background, of A in all
//               (Vázquez et al. 2001)
//   silhouette  pixels of the silhouette's visible lines, borders included (visible_ratio.h)
//
// Candidates lie evenly over a sphere between the radii of the shell that votes look in. A picture holds
// the same field of view from each of them. Entropy tells faces apart as long as they are larger than a
// pixel; of finer meshes it becomes a measure of area.

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
    std::vector<double> area, entropy, silhouette;  ///< One for each.
    /// One bit for each face and candidate: whether the middle of the face is seen.
    std::vector<std::vector<bool>> seen;
};

/// `with_seen`: whether `seen` is filled. On all threads; cancelled by the context.
ViewMeasures measure_views(const Mesh& mesh, VisibleRatioPass& pass, std::uint32_t candidates,
                           bool with_seen, const Context& context);

/// Which faces' middles are seen from a place outside the mesh's sphere.
std::vector<bool> faces_seen(const Mesh& mesh, const glm::dvec3& eye);

/// The numbers of `count` candidates: of those that are best within 20 degrees the best, then, where they do
/// not suffice, the best that are 20 degrees from all of these.
std::vector<std::size_t> best_apart(const Mesh& mesh, const std::vector<glm::dvec3>& eyes,
                                    const std::vector<double>& measure, std::size_t count);

/// Always the candidate that shows most faces not seen from those before it: what can be had.
std::vector<std::size_t> greedy_coverage(const ViewMeasures& measures, std::size_t count);

}  // namespace rimline::tools
