#pragma once

// What must hold of any surface, whatever its points are.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/points/point_surface.h"

namespace rimline::tests {

inline void check_sound(const PointSurface& surface) {
    std::array<std::uint32_t, 4> counts{};
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const PointId point{i};
        const auto range = surface.umbrellas_of(point);
        const PointLabel label = surface.label(point);
        ++counts[static_cast<std::size_t>(label)];
        const bool is_empty = label == PointLabel::undecided &&
                              surface.reason(point) != UndecidedReason::unconfirmed_border;
        REQUIRE(is_empty == (range.size() == 0));
        REQUIRE(is_empty == (surface.normal(point) == glm::dvec3(0.0)));
        REQUIRE((label == PointLabel::undecided) ==
                (surface.reason(point) != UndecidedReason::none));
        REQUIRE(is_empty == (surface.scale(point) == 0.0));
        if (label == PointLabel::feature) REQUIRE(range.size() >= 2);
        REQUIRE(std::isfinite(surface.scale(point)));
        for (std::uint32_t u = range.first; u < range.last; ++u) {
            const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
            REQUIRE(umbrella.ring.size() >= 2);
            REQUIRE(umbrella.ring.size() <= 64);
            REQUIRE(umbrella.triangle_count() >= 1);
            REQUIRE(std::bit_width(umbrella.gaps) <= umbrella.ring.size());
            REQUIRE(std::abs(glm::length(umbrella.normal) - 1.0) < 1e-9);
            std::vector<std::uint32_t> numbers;
            for (const PointId q : umbrella.ring) numbers.push_back(index(q));
            std::sort(numbers.begin(), numbers.end());
            REQUIRE(std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end());
            REQUIRE(numbers.back() < surface.size());
            REQUIRE(!std::binary_search(numbers.begin(), numbers.end(), i));
            if (label == PointLabel::interior) REQUIRE((range.size() == 1 && umbrella.is_closed()));
        }
    }
    for (std::size_t label = 0; label < 4; ++label)
        REQUIRE(surface.count(static_cast<PointLabel>(label)) == counts[label]);
}

}  // namespace rimline::tests
