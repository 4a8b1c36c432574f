#pragma once

// Where a silhouette is seen from: a viewpoint (p, 1) or a direction (v, 0).
//
// A direction points from the model towards the viewer or the light. There is no other w, so that
// w * d is exact and the face bit of plane.h needs no rounding of its own there. Make points with
// viewpoint() and direction(); trackers and trees refuse what is_valid() does not hold for.

#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/error.h"

namespace rimline {

/// Coordinates of meshes and points lie in [-k_max_coordinate, k_max_coordinate]: sums of squares
/// stay finite in float.
constexpr float k_max_coordinate = 0x1p60f;

/// Components smaller than this in a point are zero. With plane.h's own limit no product or sum of
/// the face bit is ever subnormal, so it does not matter what a device does with subnormals.
constexpr float k_min_point_component = 0x1p-60f;

struct HomogeneousPoint {
    float x, y, z;
    float w;  ///< 1 for a viewpoint, 0 for a direction.

    /// Whether viewpoint() and direction() take a vector: finite, and within k_max_coordinate.
    static bool is_valid(glm::vec3 v) noexcept {
        return std::abs(v.x) <= k_max_coordinate && std::abs(v.y) <= k_max_coordinate &&
               std::abs(v.z) <= k_max_coordinate;  // False for NaN too.
    }
    /// Whether this is a point that viewpoint() or direction() could have made.
    bool is_valid() const noexcept {
        const auto is_snapped = [](float c) {
            return c == 0.0f || std::abs(c) >= k_min_point_component;
        };
        return is_valid(xyz()) && is_snapped(x) && is_snapped(y) && is_snapped(z) &&
               (w == 0.0f || w == 1.0f);
    }

    /// `p` must be valid.
    static HomogeneousPoint viewpoint(glm::vec3 p) noexcept {
        RIMLINE_CHECK(is_valid(p));
        return {snapped(p.x), snapped(p.y), snapped(p.z), 1.0f};
    }
    /// `v` must be valid. It need not be a unit vector: its length does not matter as long as no
    /// component that counts is below k_min_point_component.
    static HomogeneousPoint direction(glm::vec3 v) noexcept {
        RIMLINE_CHECK(is_valid(v));
        return {snapped(v.x), snapped(v.y), snapped(v.z), 0.0f};
    }

    bool is_direction() const noexcept { return w == 0.0f; }
    glm::vec3 xyz() const noexcept { return {x, y, z}; }
    bool operator==(const HomogeneousPoint&) const noexcept = default;

private:
    static float snapped(float c) noexcept {
        return std::abs(c) < k_min_point_component ? 0.0f : c;
    }
};

}  // namespace rimline
