#pragma once

// Both sides of a crease (thesis 5.2.4): from a point with a partial umbrella, the umbrella that fills its
// gap with the points that the first one does not explain; or the two that the first one parts into.

#include <optional>

#include "silhouette/points/star_choice.h"

namespace rimline {

/// `fan` has one gap. A fan with one gap too, whose ends are those of `fan`, running on where it ends;
/// of no umbrella where there is none. Its plane is that of a neighbor's star, nearest first; neighbors
/// within 25 degrees of a triangle of `fan`, seen in its plane, are left out, and so is a fan that lies
/// within 20 degrees of folding back onto `fan`, or that has a triangle above 130 degrees and turns from
/// `fan` by less than 75: noise leaves such triangles before a border.
Fan find_supplement(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                    const Stars& stars, double gap_ratio);

/// Both sides of a crease, either with one gap, the second running on where the first ends.
struct SplitFan {
    Fan fan, supplement;
};
/// At an edge sharper than about 35 degrees a fan takes points of both sides in turn, and its gap is what lies
/// before the edge. Where a triangle of it deviates by more than 45 degrees the neighbors are parted by the
/// plane in the middle, and each side has a fan of its own between the same ends. Nothing where one has none,
/// or where they lie within 20 degrees of each other: two sheets may do so behind a border.
std::optional<SplitFan> split_fold(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                                   const Stars& stars, double gap_ratio);

}  // namespace rimline
