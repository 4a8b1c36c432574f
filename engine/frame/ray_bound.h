#pragma once

// Upper bound of the triangles of a shadow volume that one ray from the light meets, from the volume's sides.
//
// Let K(r) be the number of triangles that the ray r from the light meets, as the volume counts them. K
// changes only where the ray crosses the volume's sides, by the number of sides drawn there. Turn the ray along
// a meridian (in a half plane through the light and an axis) from one pole to the other. Then K goes from its
// value at one pole to its value at the other, and every K(r) in between is at most half of the sum of both
// values and of all sides crossed. So
//
//     K(r)  <=  (K(pole) + K(other pole) + sides that span the meridian of r) / 2
//
// The axis is parallel to a coordinate axis of the mesh. If the light is outside of the volume's bounds, one
// such axis passes outside too, and K is 0 at both poles. If it is within, the caller counts the faces at the
// poles. For a directional light, planes parallel to the light and the axis replace the half planes.
//
// Meridians are counted in bins of the interval that the bounds cover, so a light far away has the bound of a
// directional light. Each side is counted in the bins that it spans, widened by the rounding of its ends.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame/volume_sides.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The coordinate along which a light lies farthest outside of `bounds`, or for a directional light its
/// greatest. Empty if a light lies within, or outside by no more than rounding.
std::optional<int> outer_axis(const Bounds& bounds, const HomogeneousPoint& light);

/// Keeps its memory between calls. Not to be used by two threads at once.
class RayBound {
public:
    /// Of a light outside of `bounds`, the bounds of all sides; `outer` is its outer_axis(). O(sides). Where the
    /// bound by one axis is above `enough`, another axis is tried.
    std::uint32_t from_outside(const VolumeSides& sides, const Bounds& bounds,
                               const HomogeneousPoint& light, int outer, std::uint32_t enough);
    /// Of a point light, from anywhere. `faces_at_poles` is at least the number of triangles that the line
    /// through the light along `axis` meets. O(sides).
    std::uint32_t from_within(const VolumeSides& sides, const HomogeneousPoint& light, int axis,
                              std::uint32_t faces_at_poles);

private:
    template <typename Meridians>
    std::int64_t most_on_meridian(const VolumeSides& sides, const Meridians& meridians);

    // By bin: sides that span it, minus those that span the bin before.
    std::vector<std::int32_t> steps_;
};

}  // namespace rimline
