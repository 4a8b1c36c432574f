#pragma once

// How many triangles of a shadow volume lie between the near rectangle and a light, where that is the same number
// for all of the rectangle. Depth pass then counts from this number on instead of from 0, and needs no caps,
// although the camera may be in shadow.
//
// The number changes only at the sides of the volume, and at its triangles. So let no triangle meet the ball around
// the eye that contains the near rectangle. And let no edge that casts a side meet the way from this ball to the
// light, as thick as the ball. Then the number is that of the triangles that the segment from the eye to the light
// crosses. All distances include the shaders' rounding. Where rounding here leaves a crossing in doubt, there is no
// number.
// Source: Hornus et al., ZP+: correct Z-pass stencil shadows, 2005, where the near plane's number is drawn.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/frame/counted_volume.h"
#include "engine/shadow_choice.h"

namespace rimline {

/// Of the whole volume, or of each of the parts of `count`, if there are some. The view must be perspective. Uses
/// CasterMesh::faces(). Some hundred microseconds. Empty where there is not one number.
std::optional<std::vector<std::uint32_t>> near_counts(const CountedVolume& volume,
                                                      const VolumeCount& count,
                                                      const ShadowView& view);

/// near_counts() of one mesh that does not deform, kept for as long as light, form and eye rest.
class NearCounter {
public:
    /// `count` must have its parts. Valid until the next call.
    const std::optional<std::vector<std::uint32_t>>& counts(const CountedVolume& volume,
                                                            const VolumeCount& count,
                                                            const ShadowView& view);

private:
    struct Key {
        HomogeneousPoint light;
        ShadowForm form;
        glm::dvec3 eye;
        double near_reach;
        bool operator==(const Key&) const = default;
    };
    std::optional<Key> key_;
    std::optional<std::vector<std::uint32_t>> counts_;
};

}  // namespace rimline
