#pragma once

// The other side of a crease (thesis 5.2.4): from a point with a partial umbrella, the umbrella that fills
// its gap with the points that the first one does not explain.

#include <span>

#include "silhouette/points/star_choice.h"

namespace rimline {

/// `fan` has one gap. A fan with one gap too, whose ends are those of `fan`, running on where it ends;
/// of no umbrella where there is none. Its plane is that of a neighbour's star, nearest first; neighbours
/// within 15 degrees of a triangle of `fan`, seen in its plane, are left out, and so is a fan that lies
/// within 20 degrees of folding back onto `fan`.
Fan find_supplement(const Neighbourhood& around, std::uint32_t point, const Fan& fan,
                    const Stars& stars, double gap_ratio);

}  // namespace rimline
