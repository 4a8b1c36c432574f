#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace rimline {

template <typename T>
bool is_finite(const glm::vec<3, T>& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace rimline
