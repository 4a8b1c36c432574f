#pragma once

// The point that a silhouette belongs to: a viewpoint (p, 1) or a direction (v, 0).
//
// A direction points from the model towards the viewer or the light. w is 0 or 1 only, so the
// product w * d in the face bit of plane.h is exact. Make points with viewpoint() and direction().
// Trackers and trees reject points that are not is_valid().

#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/error.h"

namespace rimline {

/// Coordinates of meshes and points lie in [-k_max_coordinate, k_max_coordinate]. Sums of their
/// squares are then finite in float.
constexpr float k_max_coordinate = 0x1p60f;

/// Smaller components of a point are set to 0. With the limits in plane.h, no product or sum in the
/// face bit is subnormal, so results do not depend on how a device treats subnormals.
constexpr float k_min_point_component = 0x1p-60f;

struct HomogeneousPoint {
    float x, y, z;
    float w;  ///< 1 for a viewpoint, 0 for a direction.

    /// Whether viewpoint() and direction() accept a vector: finite and within k_max_coordinate.
    static bool is_valid(glm::vec3 v) noexcept {
        return std::abs(v.x) <= k_max_coordinate && std::abs(v.y) <= k_max_coordinate &&
               std::abs(v.z) <= k_max_coordinate;  // False for NaN too.
    }
    /// Whether viewpoint() or direction() could have made this point.
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
    /// `v` must be valid. It may have any length, but components below k_min_point_component are
    /// lost.
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
