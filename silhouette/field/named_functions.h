#pragma once

// The tangential distance functions of the thesis: the parts of Figures 4.2 to 4.4 and the functions of
// the three applications, Figures 4.8, 4.10 and 4.18. The figures have no scales. docs/results/field.md
// explains the chosen values. All distances are in unit coordinates (unit_planes.h), all values in [0,
// 1]. All steps are S(x) = 3x^2 - 2x^3.

#include <optional>
#include <span>
#include <string_view>

#include "silhouette/field/tangential_function.h"

namespace rimline {

// Parts. Widths are positive, 0 <= from < to (RIMLINE_CHECK).

/// Figure 4.2, left: 0 behind, 1 in front, with the step from -width/2 to width/2.
TangentialFunction front_facing(double width);
/// Figure 4.2, center: 0 for |s| <= from, 1 for |s| >= to.
TangentialFunction far_from_plane(double from, double to);
/// 1 - far_from_plane.
TangentialFunction near_plane(double from, double to);
/// Figure 4.2, right: 1 on the plane, where its edges are probably on the silhouette; 0 for |s| >= width.
TangentialFunction on_silhouette(double width);
/// 1 - on_silhouette.
TangentialFunction off_silhouette(double width);
/// Figure 4.3, left: far_from_plane in front, 0 behind.
TangentialFunction far_in_front(double from, double to);
/// Figure 4.3, right: the step of front_facing(width), then near_plane. width/2 <= from.
TangentialFunction near_in_front(double width, double from, double to);

// Viewing angles (Figure 4.4): the angle between ray and plane. Its sine is about s / reach at the
// distance `reach` from the mesh. In front of the plane the three functions sum to 1.

TangentialFunction small_viewing_angle(double reach);     ///< 1 at 0, 0 from reach/2 on.
TangentialFunction moderate_viewing_angle(double reach);  ///< 1 at reach/2: π/6.
TangentialFunction large_viewing_angle(double reach);     ///< 0 at reach/2, 1 from reach on: π/2.

// Applications.

/// For origins of Hough spaces (4.4, Figure 4.8), in a ball of radius 3: 0 on the plane, 1 at |s| =
/// alpha/2, 0 for |s| >= alpha.
TangentialFunction origin_function(double alpha = 1.0);
/// For viewpoints (4.5, Figure 4.10), in the shell from √3 to 2: 1 on the plane, 0 at |s| = alpha/2. In
/// front 1 from `plateau` on, behind a quarter of that. alpha/2 < plateau.
TangentialFunction view_function(double alpha, double plateau);
inline TangentialFunction view_function(double alpha = 1.0) { return view_function(alpha, alpha); }
/// For a light (4.6, Figure 4.18), in the same shell, for planes that face the viewpoint: 0 behind, 1 at
/// alpha/2, a third from alpha on.
TangentialFunction light_function(double alpha = 1.0);

/// A function with a name, for programs and plots.
struct NamedFunction {
    std::string_view name;  ///< Value of the option --function.
    std::string_view what;  ///< Description in one line.
    TangentialFunction function;
    double min_radius, max_radius;  ///< The ball or shell where it is used.
};
/// All named functions, parts first. Created at the first call.
std::span<const NamedFunction> named_functions();
/// Null if there is no such name.
const NamedFunction* find_named_function(std::string_view name);

}  // namespace rimline
