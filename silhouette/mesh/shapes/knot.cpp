#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/shapes/circle.h"
#include "silhouette/mesh/shapes/shape_makers.h"
#include "silhouette/mesh/shapes/tube.h"

namespace rimline {

namespace {

// The curve winds twice around the axis of a torus and three times around its center circle. Its
// strands are at least 0.89 apart and its radius of curvature is at least 0.73, so the tube does
// not intersect itself.
constexpr double k_major_radius = 1.0;
constexpr double k_minor_radius = 0.45;
constexpr double k_tube_radius = 0.25;
constexpr double k_length = 15.34;

struct Frame {
    glm::dvec3 point, normal, binormal;
};

// The normal of the torus is perpendicular to every curve on it. After a full loop it has its first
// value again, so the frame closes without a seam and needs no transport along the curve.
Frame frame_at(double t) {
    const CosSin around = cos_sin_of_turns(2.0 * t);
    const CosSin section = cos_sin_of_turns(3.0 * t);
    const double from_axis = k_major_radius + k_minor_radius * section.cos;
    const glm::dvec3 normal(section.cos * around.cos, section.cos * around.sin, section.sin);
    const glm::dvec3 along_axis_turn(-around.sin, around.cos, 0.0);
    const glm::dvec3 along_section(-section.sin * around.cos, -section.sin * around.sin,
                                   section.cos);
    const glm::dvec3 tangent =
        2.0 * from_axis * along_axis_turn + 3.0 * k_minor_radius * along_section;
    const glm::dvec3 unit_tangent = tangent / std::sqrt(glm::dot(tangent, tangent));
    return {{from_axis * around.cos, from_axis * around.sin, k_minor_radius * section.sin},
            normal,
            glm::cross(unit_tangent, normal)};
}

}  // namespace

MeshSource make_knot(std::uint32_t faces) {
    MeshSource knot;
    const double aspect = k_length / (2.0 * std::numbers::pi * k_tube_radius);
    const TubeGrid grid = tube_grid(0.5 * faces, aspect, {24, 3});
    Frame frame{};
    append_tube(knot, grid, [&](std::uint32_t ring, std::uint32_t side) {
        if (side == 0) frame = frame_at(double(ring) / grid.rings);
        const CosSin section = cos_sin_of_turns(double(side) / grid.sides);
        return frame.point +
               k_tube_radius * (section.cos * frame.normal + section.sin * frame.binormal);
    });
    return knot;
}

}  // namespace rimline
