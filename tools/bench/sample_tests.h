#pragma once

// How many samples the shadow volumes of a frame are tested at, counted on the processor: its triangles are
// rasterized at the centers of the pixels, in double, with one sample a pixel and no larger scale.

#include <cstdint>

#include "engine/scene.h"

namespace rimline {
struct DeviceContext;
}

namespace rimline::tools {

struct SampleTests {
    double drawn_area = 0.0;  ///< In the rectangle around the scene (drawn_rect.h).
    double rectangle =
        0.0;  ///< In the rectangle of each shadow (shadow_bounds.h), which is what is drawn.
    double depth = 0.0;  ///< Of these, where the surface's depth is in the shadow's interval too.
    /// Of those in the rectangle, fragments that do not lie behind that interval: what volumes that end there would
    /// at least be tested at.
    double ended = 0.0;
};

/// Of all casters and lights. Volumes drawn in parts count as if they were drawn whole. Draws the scene for its
/// depths; no instance may deform. About 2 ns for each sample and 100 ns for each side.
SampleTests count_sample_tests(const DeviceContext& context, const Scene& scene,
                               std::uint32_t width, std::uint32_t height);

}  // namespace rimline::tools
