#pragma once

// A direction scaled by a power of two, so that its squares are neither subnormal nor infinite.

#include <algorithm>
#include <cmath>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// Directions come back with their greatest component in [1, 2), viewpoints and no direction at all
/// unchanged. On which side of a plane a direction points stays exactly the same.
inline HomogeneousPoint scaled_direction(const HomogeneousPoint& point) noexcept {
    const float greatest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    if (!point.is_direction() || greatest == 0.0f) return point;
    const int exponent = -std::ilogb(greatest);
    return {std::ldexp(point.x, exponent), std::ldexp(point.y, exponent),
            std::ldexp(point.z, exponent), 0.0f};
}

}  // namespace rimline
