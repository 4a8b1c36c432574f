#pragma once

// The active region (thesis 3.4): the symmetric difference of two v-spheres. The faces that turn
// between two silhouette points have their Hough points in it.

#include "silhouette/hough/v_sphere.h"

namespace rimline {

/// The position of a box relative to the two v-spheres; `mixed` means "not certain".
struct RegionSides {
    VSphereSide before;
    VSphereSide after;

    /// Certainly no face in the box turns.
    bool is_apart() const noexcept { return before == after && before != VSphereSide::mixed; }
    /// Certainly every face in the box turns.
    bool is_contained() const noexcept {
        return before != after && before != VSphereSide::mixed && after != VSphereSide::mixed;
    }
};

class ActiveRegion {
public:
    ActiveRegion(const VSphere& before, const VSphere& after) noexcept
        : before_(before), after_(after) {}

    RegionSides sides_of(const HoughBox& box, float reach) const noexcept {
        return {before_.side_of(box, reach), after_.side_of(box, reach)};
    }

private:
    VSphere before_;
    VSphere after_;
};

}  // namespace rimline
