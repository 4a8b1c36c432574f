#include "engine/frame/bounding_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace rimline {

namespace {

// Across the planes, where the box is a cube from -1 to 1. A determinant of three of them is an integer.
constexpr std::array<std::array<double, 3>, 13> k_lines{{{1, 0, 0},
                                                         {0, 1, 0},
                                                         {0, 0, 1},
                                                         {1, 1, 0},
                                                         {1, -1, 0},
                                                         {1, 0, 1},
                                                         {1, 0, -1},
                                                         {0, 1, 1},
                                                         {0, 1, -1},
                                                         {1, 1, 1},
                                                         {1, 1, -1},
                                                         {1, -1, 1},
                                                         {1, -1, -1}}};
// Planes are moved outwards by this, far more than the arithmetic rounds; corners may be outside by a tenth of it.
constexpr double k_slack = 1e-9;

glm::dvec3 line(std::size_t number) {
    const std::array<double, 3>& line = k_lines[number];
    return {line[0], line[1], line[2]};
}

// Between the planes across one line.
struct Slab {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};
using Slabs = std::array<Slab, k_lines.size()>;

bool is_within(const Slabs& slabs, const glm::dvec3& point) {
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        const double along = glm::dot(line(i), point);
        if (!(along >= slabs[i].low - 0.1 * k_slack && along <= slabs[i].high + 0.1 * k_slack))
            return false;
    }
    return true;
}

// Where three planes of different lines meet, within all others.
std::vector<glm::dvec3> corners_of(const Slabs& slabs) {
    std::vector<glm::dvec3> corners;
    const auto add = [&](const glm::dvec3& corner) {
        const auto is_near = [&](const glm::dvec3& other) {
            const glm::dvec3 off = glm::abs(corner - other);
            return std::max({off.x, off.y, off.z}) < 0.1 * k_slack;
        };
        if (is_within(slabs, corner) && std::ranges::none_of(corners, is_near))
            corners.push_back(corner);
    };
    for (std::size_t a = 0; a < slabs.size(); ++a)
        for (std::size_t b = a + 1; b < slabs.size(); ++b)
            for (std::size_t c = b + 1; c < slabs.size(); ++c) {
                const glm::dmat3 rows = glm::transpose(glm::dmat3(line(a), line(b), line(c)));
                if (std::abs(glm::determinant(rows)) < 0.5) continue;
                const glm::dmat3 inverse = glm::inverse(rows);
                for (const double x : {slabs[a].low, slabs[a].high})
                    for (const double y : {slabs[b].low, slabs[b].high})
                        for (const double z : {slabs[c].low, slabs[c].high})
                            add(inverse * glm::dvec3(x, y, z));
            }
    return corners;
}

}  // namespace

std::vector<glm::dvec3> polytope_around(std::span<const glm::vec3> points) {
    if (points.empty()) return {};
    glm::vec3 low = points[0];
    glm::vec3 high = points[0];
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::dvec3 center = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
    glm::dvec3 half = 0.5 * (glm::dvec3(high) - glm::dvec3(low));
    for (int axis = 0; axis < 3; ++axis)
        if (half[axis] == 0.0) half[axis] = 1.0;
    Slabs slabs;
    for (const glm::vec3& point : points) {
        const glm::dvec3 in_cube = (glm::dvec3(point) - center) / half;
        for (std::size_t i = 0; i < slabs.size(); ++i) {
            const double along = glm::dot(line(i), in_cube);
            slabs[i].low = std::min(slabs[i].low, along);
            slabs[i].high = std::max(slabs[i].high, along);
        }
    }
    for (Slab& slab : slabs) {
        slab.low -= k_slack;
        slab.high += k_slack;
    }
    std::vector<glm::dvec3> corners = corners_of(slabs);
    for (glm::dvec3& corner : corners) corner = center + half * corner;
    return corners;
}

}  // namespace rimline
