#pragma once

// A direction scaled by a power of two, so that its squares are neither subnormal nor infinite.

#include <algorithm>
#include <cmath>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// Returns a direction with its greatest component in [1, 2). Viewpoints and the zero vector stay unchanged.
/// The side of a plane to which a direction points is exactly the same.
inline HomogeneousPoint scaled_direction(const HomogeneousPoint& point) noexcept {
    const float greatest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    if (!point.is_direction() || greatest == 0.0f) return point;
    const int exponent = -std::ilogb(greatest);
    return {std::ldexp(point.x, exponent), std::ldexp(point.y, exponent),
            std::ldexp(point.z, exponent), 0.0f};
}

}  // namespace rimline
