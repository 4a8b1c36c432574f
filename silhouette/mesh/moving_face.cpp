#include "silhouette/mesh/moving_face.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

constexpr float k_min_corner_component = 0x1p-100f;
constexpr float k_min_scaled_component = 0x1p-40f;

glm::vec3 snapped(glm::vec3 v, float smallest) {
    const auto snap = [smallest](float c) { return std::abs(c) < smallest ? 0.0f : c; };
    return {snap(v.x), snap(v.y), snap(v.z)};
}

// Multiplies by the power of two that brings the largest component into [1, 2).
glm::vec3 scaled(glm::vec3 v) {
    const float max_component = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (max_component == 0.0f) return v;
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(max_component) >> 23;
    return snapped(v * std::bit_cast<float>((254u - exponent) << 23), k_min_scaled_component);
}

// Splits each component into two parts of at most 12 bits (Veltkamp).
struct Halves {
    glm::vec3 high, low;
};

Halves halves(glm::vec3 v) {
    const glm::vec3 wide = v * 4097.0f;
    const glm::vec3 high = wide - (wide - v);
    return {high, v - high};
}

// The rounding error of `product`: a * b - product.
glm::vec3 product_error(glm::vec3 a, glm::vec3 b, glm::vec3 product) {
    const auto [a_high, a_low] = halves(a);
    const auto [b_high, b_low] = halves(b);
    return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

glm::vec3 accurate_cross(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 a_left{a.y, a.z, a.x}, b_left{b.z, b.x, b.y};
    const glm::vec3 a_right{a.z, a.x, a.y}, b_right{b.y, b.z, b.x};
    const glm::vec3 left = a_left * b_left;
    const glm::vec3 right = a_right * b_right;
    return (left - right) +
           (product_error(a_left, b_left, left) - product_error(a_right, b_right, right));
}

}  // namespace

bool is_front(const std::array<glm::vec3, 3>& corners, const HomogeneousPoint& point) noexcept {
    const glm::vec3 v0 = snapped(corners[0], k_min_corner_component);
    const glm::vec3 a = scaled(snapped(corners[1], k_min_corner_component) - v0);
    const glm::vec3 b = scaled(snapped(corners[2], k_min_corner_component) - v0);
    const glm::vec3 n = scaled(accurate_cross(a, b));
    const glm::vec3 q = scaled(point.xyz() - v0 * point.w);
    return (n.x * q.x + n.y * q.y) + n.z * q.z > 0.0f;
}

std::vector<std::uint32_t> moving_face_bits(std::span<const Triangle> triangles,
                                            std::span<const glm::vec3> positions,
                                            const HomogeneousPoint& point) {
    std::vector<std::uint32_t> words(face_word_count(static_cast<std::uint32_t>(triangles.size())),
                                     0);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle& t = triangles[f];
        const std::array corners{positions[index(t[0])], positions[index(t[1])],
                                 positions[index(t[2])]};
        if (is_front(corners, point)) words[f / 32] |= 1u << (f % 32);
    }
    return words;
}

}  // namespace rimline
