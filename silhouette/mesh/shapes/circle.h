#pragma once

// Sine and cosine with the same results on every machine.
//
// Those of the standard library differ in the last bit between systems, so vertices of shapes would
// differ, too. These functions reduce the angle exactly to an eighth of a turn and then use the
// Taylor series. Angles are in turns, so quarter turns give exactly 0 and 1.

#include <cmath>
#include <numbers>

namespace rimline {

struct CosSin {
    double cos, sin;
};

/// Cosine and sine of `turns` full turns, which must be finite and not huge. The error is below
/// 2^-50.
inline CosSin cos_sin_of_turns(double turns) noexcept {
    const double in_turn = turns - std::floor(turns);
    const double quarter = std::floor(4.0 * in_turn + 0.5);
    const double x = 2.0 * std::numbers::pi * (in_turn - 0.25 * quarter);  // |x| <= pi / 4.
    const double xx = x * x;
    double cos = 1.0;
    double sin = 1.0;
    for (int k = 9; k >= 1; --k) {  // Omitted terms are below 2^-60.
        cos = 1.0 - xx / ((2 * k - 1) * (2 * k)) * cos;
        sin = 1.0 - xx / ((2 * k) * (2 * k + 1)) * sin;
    }
    sin *= x;
    switch (static_cast<int>(quarter) % 4) {
        case 1: return {-sin, cos};
        case 2: return {-cos, -sin};
        case 3: return {sin, -cos};
        default: return {cos, sin};
    }
}

}  // namespace rimline
