#pragma once

// Origins for Hough spaces (thesis 4.4): points from which few edges are on the silhouette, and whose
// distances from the mesh's planes spread its Hough points well.
//
// They are the points of interest of origin_function(alpha) in the ball of radius 3 around the mesh in
// unit coordinates, so the first k are the same however many are asked for. HoughOctree takes them and
// groups the faces (4.4.4).
//
// How many. As the thesis says, by trying: for the center alone and for the first 1, 2, .. points, an
// octree is built and the silhouette extracted from viewpoints spread over spheres of 1, 2 and 3 radii
// (4.4.6); the least work counted wins. Work is what HoughOctree counts, a box for 1 and an edge for 2,
// about what they take of the clock: the same on every machine.
//
// What they bring. In the thesis's octree two to three times fewer box checks. In HoughOctree, whose boxes
// hold both ends of an edge, up to a seventh of the work, and on some meshes nothing (docs/field.md): then
// the center is chosen, and ChosenOrigins::best is 0.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct OriginOptions {
    double alpha = 1.72;            ///< Of origin_function; positive.
    double field_tolerance = 1e-2;  ///< FieldOptions::tolerance.
    double tolerance = 1e-3;        ///< Of positions, in radii of the mesh.
};

struct FoundOrigins {
    std::vector<glm::dvec3> origins;  ///< In the mesh's coordinates.
    std::vector<double> votes;  ///< Of each, what those before it left, as a share of all planes.
};

/// Fewer than `count` where no plane has votes left: all of a box's, say, go to its center. At least the
/// center, with no votes, where there is none at all.
FoundOrigins find_origins(const Mesh& mesh, std::uint32_t count, const OriginOptions& options = {},
                          const LongCall& call = {});

/// One number of origins, tried.
struct OriginTrial {
    std::uint32_t count = 0;  ///< 0: the center of the mesh.
    HoughOctreeStatistics statistics;
    TraversalCounters mean;  ///< Of an extraction.
    double work = 0.0;       ///< box_checks + 2 edge_checks, mean.
};

/// `origins` as HoughOctreeOptions takes them; empty: the center. Of `viewpoints` extractions.
OriginTrial try_origins(const Mesh& mesh, std::vector<glm::dvec3> origins, std::uint32_t viewpoints,
                        const LongCall& call = {});

struct ChosenOrigins {
    FoundOrigins found;               ///< All that were tried.
    std::vector<OriginTrial> trials;  ///< From 0 up.
    std::uint32_t best = 0;           ///< The trial with the least work; of equal ones the first.
};

/// Tries 0 to `most` origins.
ChosenOrigins choose_origins(const Mesh& mesh, std::uint32_t most = 5,
                             std::uint32_t viewpoints = 600, const OriginOptions& options = {},
                             const LongCall& call = {});

}  // namespace rimline
