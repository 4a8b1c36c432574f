#pragma once

// Outward rounding: from a bound in double to a bound in float.

#include <cmath>
#include <limits>

namespace rimline {

/// The minimum float that is not below `value`.
inline float rounded_up(double value) noexcept {
    const auto rounded = static_cast<float>(value);
    return double{rounded} >= value
               ? rounded
               : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

/// The maximum float that is not above `value`.
inline float rounded_down(double value) noexcept { return -rounded_up(-value); }

}  // namespace rimline
