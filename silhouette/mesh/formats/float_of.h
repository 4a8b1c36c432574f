#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

namespace rimline {

/// The nearest float. Beyond the range of floats it is infinite, as IEEE 754 rounds; the language leaves the
/// conversion of such values undefined. Readers that have no limit of their own for a number of a file take this, and
/// treat what is infinite as they treat an infinite number of the file.
inline float float_of(double value) noexcept {
    constexpr double k_max = std::numeric_limits<float>::max();
    constexpr double k_first_infinite = 0x1.ffffffp127;  // Halfway from k_max to 2^128.
    if (!(std::abs(value) > k_max)) return static_cast<float>(value);
    const double size =
        std::abs(value) < k_first_infinite ? k_max : std::numeric_limits<double>::infinity();
    return static_cast<float>(std::copysign(size, value));
}

inline glm::vec3 float_of(const glm::dvec3& v) noexcept {
    return {float_of(v.x), float_of(v.y), float_of(v.z)};
}

}  // namespace rimline
