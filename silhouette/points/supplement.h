#pragma once

// Both sides of a crease (thesis 5.2.4), from a point with a partial umbrella: either a second umbrella fills
// the gap of the first with points that the first does not explain, or the first is split into two.

#include <optional>

#include "silhouette/points/star_choice.h"

namespace rimline {

/// `fan` has one gap. Returns a fan that continues it: with one gap too, between the same ends. Returns a fan
/// without triangles where there is none. The plane is that of a neighbor's star; the nearest comes first.
/// Neighbors that `fan` explains are left out: those within 25 degrees of one of its triangles. A fan is
/// refused if it folds back onto `fan` within 20 degrees. It is also refused if it has a triangle above 130
/// degrees and turns from `fan` by less than 75 degrees: noise leaves such triangles before a border.
Fan find_supplement(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                    const Stars& stars, double gap_ratio);

/// Both sides of a crease. Each has one gap, and the second continues the first.
struct SplitFan {
    Fan fan, supplement;
};
/// At an edge sharper than about 35 degrees, a fan takes points of both sides in turn, and has its gap on the
/// outer side of the edge. Where one of its triangles deviates by more than 45 degrees from its normal, the
/// plane that bisects the edge separates the neighbors, and each side gets a fan between the same ends.
/// Returns nothing where a side has no fan, or where the sides lie within 20 degrees of each other: so may
/// two sheets behind a border.
std::optional<SplitFan> split_fold(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                                   const Stars& stars, double gap_ratio);

}  // namespace rimline
