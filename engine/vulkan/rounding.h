#pragma once

// Integers rounded up to whole units.

namespace rimline {

/// How many units of `unit` hold `value`. value + unit - 1 must not overflow.
template <typename Unsigned>
constexpr Unsigned units_of(Unsigned value, Unsigned unit) noexcept {
    return (value + unit - 1) / unit;
}

/// The smallest multiple of `unit` that is at least `value`. value + unit - 1 must not overflow.
template <typename Unsigned>
constexpr Unsigned rounded_up(Unsigned value, Unsigned unit) noexcept {
    return units_of(value, unit) * unit;
}

}  // namespace rimline
