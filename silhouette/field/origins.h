#pragma once

// Origins for Hough spaces (thesis 4.4). Few edges are on the silhouette as seen from an origin, and its
// distances from the mesh's planes spread the Hough points well.
//
// Origins are the points of interest of origin_function(alpha) in the ball of radius 3 around the mesh, in
// unit coordinates. The first k are the same for every requested count. HoughOctree groups the faces by
// them (4.4.4).
//
// Their number is found by trials, as in the thesis. For the center alone and for the first 1, 2, ..
// points, a trial builds an octree and extracts silhouettes from viewpoints on spheres of 1, 2 and 3 radii
// (4.4.6). The trial with the least work wins. Work counts 1 per box and 2 per edge tested in HoughOctree,
// about proportional to their times. It is the same on every machine.
//
// The thesis reports half to a third of the box checks with origins and alpha = 1.72. In octrees built as it says
// we measure with that alpha 14% fewer on one mesh, 9% on another, and 11% more on a third. HoughOctree, whose
// boxes hold both ends of an edge, needs the least work at an alpha of about 1, where origins save 6 to 19% on
// five meshes (docs/results/field.md). Where they save nothing the center is chosen, and ChosenOrigins::best is 0.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct OriginOptions {
    double alpha = 1.0;             ///< Argument of origin_function. Positive.
    double field_tolerance = 1e-2;  ///< FieldOptions::tolerance.
    double tolerance = 1e-3;        ///< Tolerance of positions, in radii of the mesh.
};

struct OriginSet {
    std::vector<glm::dvec3> origins;  ///< In the mesh's coordinates.
    /// By origin: the votes that earlier origins left, as a share of all planes.
    std::vector<double> votes;
};

/// Returns fewer than `count` origins if no plane has votes left. For a box, for example, the center gets
/// all votes. Returns the center with 0 votes if there is no other origin. Throws Error{too_large} if origins around
/// the mesh exceed the range of coordinates, and Error{cancelled}.
OriginSet find_origins(const Mesh& mesh, std::uint32_t count, const OriginOptions& options = {},
                       const LongCall& call = {});

/// The trial of one number of origins.
struct OriginTrial {
    std::uint32_t count = 0;  ///< 0: the center of the mesh.
    HoughOctreeStatistics statistics;
    TraversalCounters mean;  ///< Mean of one extraction.
    double work = 0.0;       ///< box_checks + 2 edge_checks, mean.
};

/// `origins` as in HoughOctreeOptions. Empty: the center. Measures `viewpoints` extractions; not 0.
OriginTrial try_origins(const Mesh& mesh, std::vector<glm::dvec3> origins, std::uint32_t viewpoints,
                        const LongCall& call = {});

struct ChosenOrigins {
    OriginSet found;                  ///< All tried origins.
    std::vector<OriginTrial> trials;  ///< For 0, 1, 2, .. origins.
    std::uint32_t best = 0;           ///< The first trial with the least work.
};

/// Tries 0 to `max_count` origins, which is not 0, by `viewpoints` extractions each; not 0.
ChosenOrigins choose_origins(const Mesh& mesh, std::uint32_t max_count = 5,
                             std::uint32_t viewpoints = 600, const OriginOptions& options = {},
                             const LongCall& call = {});

}  // namespace rimline
