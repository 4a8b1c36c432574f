#pragma once

#include <glm/vec2.hpp>

namespace rimline {

/// Twice the area of the triangle 0, u, v: positive where v lies to the left of u.
inline double cross_2d(const glm::dvec2& u, const glm::dvec2& v) noexcept {
    return u.x * v.y - u.y * v.x;
}

}  // namespace rimline
