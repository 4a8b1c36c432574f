#pragma once

// What a mesh says of its vertices, when its faces are thrown away and PointSurface has to find it again.
//
// Which models count is computed, from the mesh alone:
//   fit      at least 250 vertices, oriented, no edge of three faces or more, no face without an area.
//   open     fit, with border edges. Of these, wide: at 90% of its border vertices the opening spans at
//            least three local spacings. An opening narrower than that looks like a larger triangle.
//   smooth   fit and closed, and at 99% of its vertices no face turns more than 60 degrees from the
//            vertex's normal: a smooth surface, sampled well enough to look like one.

#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

constexpr double k_degree = std::numbers::pi / 180.0;  ///< In radians.

struct PointTruth {
    std::vector<glm::dvec3> positions;
    /// The mean of the faces', by their angles there, which a flat face split another way does not change
    /// (Thürmer and Wüthrich 1998); zero where there are none.
    std::vector<glm::dvec3> normals;
    std::vector<std::vector<std::uint32_t>> neighbors;  ///< Over edges.
    std::vector<std::uint8_t> is_border;
    std::vector<std::uint8_t> is_wide_at;  ///< At a border vertex, that the opening is wide there.
    std::uint32_t border_count = 0;
    std::uint32_t wide_count = 0;
    double smooth_share = 0.0;  ///< Of vertices.
    bool is_fit = false;

    bool is_open() const noexcept { return is_fit && border_count > 0; }
    bool is_wide() const noexcept { return is_open() && wide_count >= 0.9 * border_count; }
    bool is_smooth() const noexcept { return is_fit && border_count == 0 && smooth_share >= 0.99; }

    /// Whether another sheet comes nearer to the vertex than its own longest edge: a vertex more than twice
    /// that far away along edges. The points are too few there to tell one sheet from the other. O(vertices).
    bool is_crowded(std::uint32_t vertex) const;
};

/// At a border vertex the opening is wide where its faces leave at least 100 degrees free and no other
/// vertex lies in what they leave, seen along the vertex's normal, by area: nearer than three times the mean
/// length of its edges, within 45 degrees of the tangent plane, and 30 degrees away from its faces.
PointTruth point_truth(const Mesh& mesh);

/// How many of a closed mesh's vertices that were `found` to be a border, by number, surround holes in its
/// samples. The faces between found vertices alone, where they hang together, are such a hole if no vertex
/// goes with them when they are taken away and the opening is wide, by the rule above, at most of its
/// vertices. The mesh without these faces has the very same vertices, and nothing that sees vertices alone
/// can be right of both.
std::uint32_t count_around_holes(const Mesh& mesh, std::span<const std::uint8_t> found);

}  // namespace rimline::tools
