#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rimline {

// The nearest floats, as doubles.

inline glm::dvec3 rounded_to_float(const glm::dvec3& v) {
    glm::vec3 rounded(v);
#if defined(__GNUC__) && !defined(__clang__)
    // GCC 12 vectorizes both conversions of x and y, and then takes them for no conversion at all.
    asm("" : "+m"(rounded));
#endif
    return glm::dvec3(rounded);
}

inline glm::dmat3 rounded_to_float(const glm::dmat3& m) {
    return {rounded_to_float(m[0]), rounded_to_float(m[1]), rounded_to_float(m[2])};
}

}  // namespace rimline
