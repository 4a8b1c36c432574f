#pragma once

// What fields are compared with: the sum over all planes, one by one, in double.

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/field/tangential_field.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

inline double weight_of(const UnitPlanes& planes, std::size_t i, FieldOptions::Weight weight) {
    return weight == FieldOptions::Weight::area ? planes.area(i) : 1.0;
}

inline double reference_sum(const UnitPlanes& planes, const TangentialFunction& f,
                            FieldOptions::Weight weight, const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i)
        sum += weight_of(planes, i, weight) * f.value(planes.distance(i, point));
    return sum;
}

/// Votes beyond those for the best of `chosen`.
inline double reference_discounted(const UnitPlanes& planes, const TangentialFunction& f,
                                   FieldOptions::Weight weight, std::span<const glm::dvec3> chosen,
                                   const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        double previous = f.value(planes.distance(i, chosen.front()));
        for (const glm::dvec3& c : chosen)
            previous = std::max(previous, f.value(planes.distance(i, c)));
        sum += weight_of(planes, i, weight) *
               std::max(0.0, f.value(planes.distance(i, point)) - previous);
    }
    return sum;
}

/// In a ball of radius 3, some of them far outside and at the center.
inline std::vector<glm::dvec3> probe_points(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<glm::dvec3> points = {{0, 0, 0}, {100, -50, 3}, {0, 0, 1e6}};
    while (points.size() < count) points.push_back(3.0 * glm::dvec3(random.in_cube()));
    return points;
}

}  // namespace rimline::tests
