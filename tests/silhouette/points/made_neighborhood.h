#pragma once

// One point at the origin with made neighbors, and umbrellas of it, written as text.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <numeric>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "silhouette/points/neighborhood.h"

namespace rimline::tests {

/// Place i of the list is neighbor i. Those that rules call nearest must come first.
struct MadeNeighborhood {
    std::vector<glm::dvec3> points{glm::dvec3(0.0)};
    std::vector<std::uint32_t> list;
    Neighborhood around;

    explicit MadeNeighborhood(const std::vector<glm::dvec3>& neighbors) : list(neighbors.size()) {
        points.insert(points.end(), neighbors.begin(), neighbors.end());
        std::iota(list.begin(), list.end(), 1u);
        around.assign(points, 0, list);
    }
    MadeNeighborhood(const MadeNeighborhood&) = delete;
};

/// The neighbor in that direction from the x axis in the plane z = 0, moved by z.
inline glm::dvec3 at_deg(double angle_deg, double radius = 1.0, double z = 0.0) {
    const double angle = glm::radians(angle_deg);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// "0 1 | 2": the ring 0 1 2, with a gap between 1 and 2.
inline Fan fan_of(const std::string& text) {
    std::istringstream words(text);
    Fan fan;
    for (std::string word; words >> word;)
        if (word == "|")
            fan.open(fan.size - 1u);
        else
            fan.ring[fan.size++] = static_cast<std::uint8_t>(std::stoi(word));
    return fan;
}

/// The same text; it begins with the lowest place.
inline std::string text_of(const Fan& fan) {
    std::string text;
    std::size_t j = static_cast<std::size_t>(
        std::min_element(fan.ring.begin(), fan.ring.begin() + fan.size) - fan.ring.begin());
    for (std::size_t n = 0; n < fan.size; ++n, j = fan.next(j)) {
        if (n > 0) text += ' ';
        text += std::to_string(fan.ring[j]);
        if (fan.is_gap(j)) text += " |";
    }
    return text;
}

/// Those of all umbrellas: "0 1 2 |, 3 4 |".
inline std::string text_of(std::span<const Fan> fans) {
    std::string text;
    for (const Fan& fan : fans) {
        if (!text.empty()) text += ", ";
        text += text_of(fan);
    }
    return text;
}

/// The set with these places.
inline std::uint64_t places(std::initializer_list<int> all) {
    std::uint64_t set = 0;
    for (const int place : all) set |= std::uint64_t{1} << place;
    return set;
}

}  // namespace rimline::tests
