#pragma once

// Random numbers for tests: the same from the same seed everywhere, unlike std's distributions.

#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace rimline::tests {

class Random {  // splitmix64
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    /// In [0, count).
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(bits() % count); }
    /// In [low, high].
    int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low + 1)));
    }
    /// In [-1, 1).
    float signed_unit() { return static_cast<float>(bits() >> 40) * 0x1p-23f - 1.0f; }
    glm::vec3 in_cube() {
        const float x = signed_unit(), y = signed_unit(), z = signed_unit();
        return {x, y, z};
    }
    template <typename T>
    void shuffle(std::vector<T>& items) {
        for (std::size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
    }

private:
    std::uint64_t state_;
};

}  // namespace rimline::tests
