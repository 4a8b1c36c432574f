#pragma once

// The few viewpoints that together show most of a mesh (thesis 4.5).
//
// Viewpoints are points of interest, in a shell around the mesh, of the field of view_function
// (named_functions.h). Every plane votes for points where its edges are probably on the silhouette, and for
// points that see its front at a right angle. It votes less for points that see its back at a right angle,
// which matters for symmetric models. The first viewpoint has the most votes. Each later one has the most
// votes that no earlier viewpoint has got, so views differ.
//
// Votes ignore occlusion. A caller may weight them by the visible share of a viewpoint's
// silhouette (4.5.3; ray_ratios.h, engine/measure/visible_ratio.h). The share is at most 1, so candidates are measured
// in descending order of votes until no other candidate can win (points_of_interest.h).

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/field/named_functions.h"
#include "silhouette/field/points_of_interest.h"
#include "silhouette/field/tangential_field.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The shell that contains the viewpoints, in radii of the mesh (4.5.3). The mesh appears large there, and
/// a field of view of 70.6° contains all of it.
inline constexpr SearchDomain k_view_shell{1.7320508075688773, 2.0};

/// Tolerance of votes. Views whose scores differ by this share of the field's maximum are equally good.
inline constexpr double k_view_tolerance = 4e-3;

/// The field whose peaks are the viewpoints. The planes of a closed inside-out mesh (winding.h) are
/// reversed, so that their fronts face outwards. Throws Error{cancelled} if `stop` is requested.
TangentialField make_view_field(const Mesh& mesh,
                                const FieldOptions& options = {.tolerance = k_view_tolerance},
                                const TangentialFunction& function = view_function(),
                                const std::stop_token& stop = {});

/// Returns the visible ratios, each in [0, 1], of viewpoints in the mesh's coordinates, in their order.
using VisibleRatios = std::function<std::vector<double>(std::span<const glm::dvec3>)>;

struct BestView {
    glm::dvec3 eye;  ///< In the mesh's coordinates.
    double votes;    ///< Votes that views chosen before have not got: a sum over planes.
    double visible_ratio = 1.0;  ///< 1 if not measured.
    /// view_preference(), if there is an up direction, times area_preference(), if there is a mesh.
    double preference = 1.0;
    double score() const noexcept { return votes * visible_ratio * preference; }
};

struct BestViewsOptions {
    std::uint32_t count = 4;
    VisibleRatios visible_ratios;  ///< Empty: votes only.
    /// Candidates to measure are the peaks of the votes and every `stride`-th sample of the lattice along
    /// each axis; not 0. 2 gives the same scores as 1 with a quarter of the candidates.
    std::uint32_t stride = 2;
    /// With `up`, the score of a view is multiplied by view_preference(): people seldom look at things from below or
    /// behind.
    std::optional<glm::dvec3> up;
    /// With the mesh of the field, the score is multiplied by area_preference(): a box is seen from a corner, and a
    /// pencil not from its end. It must live during the call.
    const Mesh* mesh = nullptr;
    /// Of the plane of symmetry across this axis, if the mesh has one: a mirror image of a chosen view counts what it
    /// adds (symmetry_axis()).
    std::optional<int> mirror_axis;
    /// For people who look at them: the first view is steady (steady_point.h), and the others come in the falling order
    /// of what each would score alone, instead of that in which they were chosen. Their `votes` stay those of the
    /// choice.
    bool for_people = false;
    bool draws_all = false;  ///< For tests: measures every candidate. The views are the same.
};

struct BestViews {
    /// In the order of choice, or that of BestViewsOptions::for_people.
    std::vector<BestView> views;
    std::uint64_t renders = 0;      ///< Viewpoints measured.
    std::uint64_t candidates = 0;   ///< Number of these with `draws_all`.
    std::uint64_t evaluations = 0;  ///< Evaluations of the field.
};

/// 1 for a viewpoint in a direction from the mesh above the horizon. Below it falls linearly to 0.5 at 60 degrees.
double height_preference(const glm::dvec3& direction, const glm::dvec3& up);

/// The factor of BestViewsOptions::up: height_preference() times 1 for a three-quarter view in front, falling with the
/// cosine of the angle to it to 0.8 on the other side. Near ties go to three-quarter views, and yet the score changes
/// smoothly with the viewpoint: a limit within which they win would make the choice depend on noise.
double view_preference(const glm::dvec3& direction, const glm::dvec3& up);

/// Of how much of the area a viewpoint shows, as a share of the most (front_area.h): 1 from 0.8 on, below it
/// (share / 0.8)^4. One face of a box is a third, two are two thirds. Chosen on boxes, cylinders and our models, of
/// whose first views one has less than 0.8 without it, rocker-arm with 0.76. After `chosen` other views it is
/// (share / 0.8)^2: what they have not shown may be small. Two views of rocker-arm so show 84% of its area, not 57%.
double area_preference(double front_share, std::size_t chosen = 0);

/// The axis across which alone the mesh is symmetric, but for three tenths of its area. O(faces).
std::optional<int> symmetry_axis(const Mesh& mesh);

/// `field` comes from make_view_field. Returns fewer than `count` views if no plane has votes left: none
/// for a mesh without planes, one for a single plane. Results do not depend on the number of threads.
/// Throws what `visible_ratios` throws, Error{too_large} if viewpoints around the mesh exceed the range of coordinates,
/// and Error{cancelled}. `options.up` is not zero.
BestViews find_best_views(const TangentialField& field, const BestViewsOptions& options = {},
                          const LongCall& call = {});

}  // namespace rimline
