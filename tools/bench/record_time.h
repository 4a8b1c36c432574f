#pragma once

// CPU time of a frame beside the trackers: what the renderer does on the calling thread from the scene to the last
// recorded command, without the time that it moves trackers or waits for them.

#include <cstdint>

#include "engine/vulkan/device.h"
#include "silhouette/hough/hough_octree.h"
#include "tools/command.h"

namespace rimline::tools {

/// Medians over frames of an orbit with lines and shadows, half a degree a frame.
struct RecordTimes {
    double sun_ms = 0.0;           ///< One sun.
    double resting_lamp_ms = 0.0;  ///< A lamp that rests within the bounds of the mesh.
    double moving_lamp_ms = 0.0;   ///< The same, on an orbit too.
};

RecordTimes time_recording(const HoughOctree& octree, const Device& device, std::uint32_t frames,
                           const Context& context);

}  // namespace rimline::tools
