#pragma once

// Sine and cosine that are the same on every machine.
//
// The standard library's differ in the last bit between systems, and a shape's vertices would too.
// Here: an exact reduction to an eighth of a turn, then the Taylor series, with additions and
// multiplications only. Angles are in turns, so quarter turns give exact zeros and ones.

#include <cmath>
#include <numbers>

namespace rimline {

struct CosSin {
    double cos, sin;
};

/// Of `turns` full turns; finite, of moderate size. Within 2^-50 of the true values.
inline CosSin cos_sin_of_turns(double turns) noexcept {
    const double in_turn = turns - std::floor(turns);
    const double quarter = std::floor(4.0 * in_turn + 0.5);
    const double x = 2.0 * std::numbers::pi * (in_turn - 0.25 * quarter);  // |x| <= pi / 4.
    const double xx = x * x;
    double cos = 1.0;
    double sin = 1.0;
    for (int k = 9; k >= 1; --k) {  // The terms left out are below 2^-60.
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
