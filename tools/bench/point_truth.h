#pragma once

// The true borders and normals of a mesh's vertices, with which PointSurface is compared where it has the
// vertices alone.
//
// The kind of a model is computed from the mesh alone:
//   fit      at least 250 vertices, oriented, no edge of three faces or more, no face without an area.
//   open     fit, with border edges. Of these, wide: at 90% of its border vertices the opening spans at
//            least three local spacings. An opening narrower than that looks like a larger triangle.
//   smooth   fit and closed, and at 99% of its vertices no face turns more than 60 degrees from the
//            vertex's normal: a smooth surface with sufficient samples.

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
    /// The mean of the faces' normals, weighted by their angles at the vertex, so that another division of
    /// a flat face does not change it (Thürmer and Wüthrich 1998). Zero for a vertex without faces.
    std::vector<glm::dvec3> normals;
    std::vector<std::vector<std::uint32_t>> neighbors;  ///< Vertices that share an edge.
    std::vector<double> turns;  ///< The greatest bend of its edges, in radians.
    std::vector<std::uint8_t> is_border;
    std::vector<std::uint8_t> is_wide_at;  ///< For a border vertex: whether the opening is wide.
    std::uint32_t border_count = 0;
    std::uint32_t wide_count = 0;
    double smooth_share = 0.0;  ///< Share of the vertices.
    bool is_fit = false;

    bool is_open() const noexcept { return is_fit && border_count > 0; }
    bool is_wide() const noexcept { return is_open() && wide_count >= 0.9 * border_count; }
    bool is_smooth() const noexcept { return is_fit && border_count == 0 && smooth_share >= 0.99; }

    /// Whether another sheet is nearer to the vertex than the vertex's longest edge: a vertex at more than
    /// twice that distance along edges. The points are too few there to distinguish the sheets.
    /// O(vertices).
    bool is_crowded(std::uint32_t vertex) const;
};

/// The opening at a border vertex is wide if its faces leave a sector of at least 100 degrees and no other
/// vertex lies in that sector, in projection along the vertex's area-weighted normal: nearer than three
/// times the mean length of its edges, within 45 degrees of the tangent plane, and 30 degrees away from its
/// faces.
PointTruth point_truth(const Mesh& mesh);

/// The number of `found` border vertices of a closed mesh that surround holes in its samples. A hole is a
/// connected set of faces whose vertices are all found, if its removal removes no vertex and leaves an
/// opening that is wide, by the rule above, at most of its vertices. The mesh without these faces has the
/// same vertices, so no method that knows only vertices can be right for both meshes. `found` has one entry
/// a vertex.
std::uint32_t count_around_holes(const Mesh& mesh, std::span<const std::uint8_t> found);

}  // namespace rimline::tools
