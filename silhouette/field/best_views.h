#pragma once

// The few viewpoints that together show a mesh best (thesis 4.5).
//
// Viewpoints are points of interest, in a shell around the mesh, of the field of view_function
// (named_functions.h): every plane votes for where its edges are likely on the silhouette, for where it is
// seen head-on, and a little for where it is seen head-on from behind, which symmetric models have. The
// first viewpoint has the most votes, and each one after it the most of those not cast yet, so that views
// differ.
//
// Votes know no occlusion. A caller who can draw weights them by how much of a viewpoint's silhouette
// is visible (4.5.3; engine/measure/visible_ratio.h). As that is never over 1, candidates are drawn in falling
// order of votes and only until none that is left can win (points_of_interest.h).

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/field/named_functions.h"
#include "silhouette/field/points_of_interest.h"
#include "silhouette/field/tangential_field.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Where viewpoints are looked for, in radii of the mesh (4.5.3): near enough to show it large, and so far
/// that a field of view of 70.6° holds all of it.
inline constexpr SearchDomain k_view_shell{1.7320508075688773, 2.0};

/// The field that viewpoints are peaks of. Of a closed mesh that is wound inside out (winding.h), the
/// planes are turned: front is where the surface is seen from.
TangentialField make_view_field(const Mesh& mesh, const FieldOptions& options = {},
                                const TangentialFunction& function = view_function());

/// Of viewpoints in the mesh's coordinates, in order, each in [0, 1].
using VisibleRatios = std::function<std::vector<double>(std::span<const glm::dvec3>)>;

struct BestView {
    glm::dvec3 eye;              ///< In the mesh's coordinates.
    double votes;                ///< That earlier views have not had: a sum over planes.
    double visible_ratio = 1.0;  ///< 1 where nobody drew it.
    double score() const noexcept { return votes * visible_ratio; }
};

struct BestViewsOptions {
    std::uint32_t count = 4;
    VisibleRatios visible_ratios;  ///< Empty: votes alone.
    /// Beside the peaks of the votes, every so-manieth sample of the lattice along each axis is a candidate
    /// to be drawn. With 2 the scores come out as with 1, of a quarter of the candidates.
    std::uint32_t stride = 2;
    bool draws_all = false;  ///< For tests: every candidate is drawn. The views are the same.
};

struct BestViews {
    std::vector<BestView> views;    ///< In the order they were chosen.
    std::uint64_t renders = 0;      ///< Viewpoints drawn.
    std::uint64_t candidates = 0;   ///< Viewpoints that drawing all would have drawn.
    std::uint64_t evaluations = 0;  ///< Of the field.
};

/// `field` is that of make_view_field. Fewer views than asked for where no plane has votes left: of a mesh
/// without planes, none; of one plane, one. Results do not depend on the number of threads. Throws what
/// `visible_ratios` throws, and Error{cancelled}.
BestViews find_best_views(const TangentialField& field, const BestViewsOptions& options = {},
                          const LongCall& call = {});

}  // namespace rimline
