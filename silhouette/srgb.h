#pragma once

// The transfer function of sRGB (IEC 61966-2-1): between the numbers in files and pictures, and linear light.

#include <cmath>
#include <glm/vec3.hpp>

namespace rimline {

/// Channels are in [0, 1].
inline glm::vec3 linear_from_srgb(const glm::vec3& srgb) {
    const auto linear = [](float c) {
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z)};
}

/// The inverse of linear_from_srgb(), up to rounding.
inline glm::vec3 srgb_from_linear(const glm::vec3& linear) {
    const auto encoded = [](float c) {
        return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
    };
    return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

}  // namespace rimline
